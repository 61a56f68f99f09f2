#include "shoal/formations/potentials/thesis.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<ThesisPotential> registered{
    "thesis", "constant attraction, unbounded repulsion (Rypkema 2015, eq. 3.3)"};

}  // namespace
}  // namespace shoal::formations
