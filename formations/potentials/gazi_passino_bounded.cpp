#include "shoal/formations/potentials/gazi_passino_bounded.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<GaziPassinoBounded> registered{
    "gazi_passino_bounded", "linear attraction, bounded repulsion (Gazi and Passino 2002)"};

}  // namespace
}  // namespace shoal::formations
