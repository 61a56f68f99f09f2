#include "shoal/formations/potentials/gazi_passino_constant.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<GaziPassinoConstant> registered{
    "gazi_passino_constant", "constant attraction, unbounded repulsion (Gazi and Passino 2002)"};

}  // namespace
}  // namespace shoal::formations
