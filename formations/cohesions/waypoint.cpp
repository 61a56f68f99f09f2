#include "shoal/formations/cohesions/waypoint.hpp"

namespace shoal::formations {
namespace {

const Register<Cohesion, TowardsWaypoint> registered{
    "waypoint", "pull towards the waypoint (as the global potential of Pinciroli et al. 2008)"};

}  // namespace
}  // namespace shoal::formations
