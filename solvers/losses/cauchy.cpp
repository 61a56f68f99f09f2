#include "shoal/solvers/losses/cauchy.hpp"

namespace shoal::solvers {
namespace {

const Register<Loss, Cauchy> registered{"cauchy", "logarithmic: the pull of outliers fades"};

}  // namespace
}  // namespace shoal::solvers
