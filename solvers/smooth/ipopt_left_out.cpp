#include "shoal/core/left_out.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

const RegisterLeftOut<Solver> registered{"SHOAL_IPOPT", {"ipopt"}};

}  // namespace
}  // namespace shoal::solvers
