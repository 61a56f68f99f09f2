#include "shoal/core/left_out.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

const RegisterLeftOut<Solver> registered{"SHOAL_CERES",
                                         {"ceres.lbfgs", "ceres.bfgs", "ceres.least_squares"}};

}  // namespace

void silence_backends() {}

}  // namespace shoal::solvers
