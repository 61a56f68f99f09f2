#include "shoal/formations/potentials/physicomimetics.hpp"

namespace shoal::formations {
namespace {

const RegisterPotential<Physicomimetics> registered{
    "physicomimetics",
    "force G / r^p, repulsive inside the separation, attractive outside (Spears et al. 2004)"};

}  // namespace
}  // namespace shoal::formations
