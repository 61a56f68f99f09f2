#include "shoal/formations/potentials/lennard_jones.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<LennardJones> registered{
    "lennard_jones", "attraction that fades as r^-7, unbounded repulsion (Pinciroli et al. 2008)"};

}  // namespace
}  // namespace shoal::formations
