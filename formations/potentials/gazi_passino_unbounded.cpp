#include "shoal/formations/potentials/gazi_passino_unbounded.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<GaziPassinoUnbounded> registered{
    "gazi_passino_unbounded", "linear attraction, unbounded repulsion (Gazi and Passino 2002)"};

}  // namespace
}  // namespace shoal::formations
