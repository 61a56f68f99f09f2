#include "shoal/solvers/losses/tukey.hpp"

namespace shoal::solvers {
namespace {

const Register<Loss, Tukey> registered{"tukey",
                                       "constant beyond a scale: outliers are ignored (biweight)"};

}  // namespace
}  // namespace shoal::solvers
