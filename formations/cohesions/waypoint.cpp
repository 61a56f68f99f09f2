#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {
namespace {

/// weight |p - w|^2 with the waypoint w, the same place for all vehicles. Pinciroli et al. 2008
/// gather their swarm by such a global potential.
struct Waypoint final : Cohesion {
  double weight = 1e-5;

  Eigen::Vector2d anchor(std::span<const Neighbour>,
                         const Eigen::Vector2d& waypoint) const override {
    return waypoint;
  }
  bool needs_waypoint() const override { return true; }
  PlaneValue at(const Eigen::Vector2d& from_anchor) const override {
    return squared_distance(weight, from_anchor);
  }

  static void declare(Options<Waypoint>& o) {
    o.number("weight", &Waypoint::weight, "1/m", at_least(0), "of the squared distance to it");
  }
};

const Register<Cohesion, Waypoint> registered{
    "waypoint", "pull towards the waypoint (as the global potential of Pinciroli et al. 2008)"};

}  // namespace
}  // namespace shoal::formations
