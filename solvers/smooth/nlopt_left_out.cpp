#include "shoal/core/left_out.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

const RegisterLeftOut<Solver> registered{
    "SHOAL_NLOPT",
    {"nlopt.lbfgs", "nlopt.slsqp", "nlopt.mma", "nlopt.ccsaq", "nlopt.tnewton", "nlopt.var2",
     "nlopt.bobyqa", "nlopt.cobyla", "nlopt.neldermead", "nlopt.sbplx", "nlopt.praxis",
     "nlopt.direct_l", "nlopt.crs2", "nlopt.isres", "nlopt.mlsl", "nlopt.stogo"}};

}  // namespace
}  // namespace shoal::solvers
