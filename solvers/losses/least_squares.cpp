#include "shoal/solvers/losses/least_squares.hpp"

namespace shoal::solvers {
namespace {

const Register<Loss, SquaredResidual> registered{"least_squares", "the square of the residual"};

}  // namespace
}  // namespace shoal::solvers
