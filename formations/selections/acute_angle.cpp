#include "shoal/formations/selections/acute_angle.hpp"

namespace shoal::formations {
namespace {

const Register<Selection, AcuteAngle> registered{
    "acute_angle",
    "virtual spring mesh: neighbours that all others see under an acute angle (Shucker and "
    "Bennett 2007)"};

}  // namespace
}  // namespace shoal::formations
