#include "shoal/solvers/registration/descent.hpp"

namespace shoal::solvers {
namespace {

const EnrolDescent<"newton"> enrolled{"newton",
                                      "trust-region Newton on exact derivatives, for any loss"};

}  // namespace
}  // namespace shoal::solvers
