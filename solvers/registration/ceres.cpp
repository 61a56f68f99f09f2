#include "shoal/solvers/registration/descent.hpp"

namespace shoal::solvers {
namespace {

const EnrolDescent<"ceres.least_squares"> enrolled{
    "ceres", "Ceres: Levenberg-Marquardt on the residuals, for any loss"};

}  // namespace
}  // namespace shoal::solvers
