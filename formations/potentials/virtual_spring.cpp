#include "shoal/formations/potentials/virtual_spring.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<VirtualSpring> registered{
    "virtual_spring", "a linear spring, for the selection acute_angle (Shucker and Bennett 2007)"};

}  // namespace
}  // namespace shoal::formations
