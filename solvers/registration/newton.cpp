#include "shoal/solvers/registration/descent.hpp"

namespace shoal::solvers {
namespace {

const RegisterDescent<"newton"> registered{
    "newton", "trust-region Newton on exact derivatives, for any loss"};

}  // namespace
}  // namespace shoal::solvers
