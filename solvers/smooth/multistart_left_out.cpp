#include "shoal/core/left_out.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

const RegisterLeftOut<Solver> registered{"SHOAL_BOOST", {"multistart"}};

}  // namespace
}  // namespace shoal::solvers
