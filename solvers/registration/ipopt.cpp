#include "shoal/solvers/registration/descent.hpp"

namespace shoal::solvers {
namespace {

const RegisterDescent<"ipopt"> registered{
    "ipopt", "Ipopt: interior point, for any loss; one solve at a time in a process"};

}  // namespace
}  // namespace shoal::solvers
