#include "shoal/solvers/registration/descent.hpp"

namespace shoal::solvers {
namespace {

const RegisterDescent<"ceres.least_squares"> registered{
    "ceres", "Ceres: Levenberg-Marquardt on the residuals, for any loss"};

}  // namespace
}  // namespace shoal::solvers
