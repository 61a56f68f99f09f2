#include "shoal/formations/cohesions/none.hpp"

namespace shoal::formations {
namespace {

const Register<Cohesion, NoCohesion> registered{"none", "nothing but the pair potentials"};

}  // namespace
}  // namespace shoal::formations
