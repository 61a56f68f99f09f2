#pragma once

#include <span>

#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {

/// weight |p - w|^2 with the waypoint w, the same place for all vehicles. Pinciroli et al. 2008
/// gather their swarm by such a global potential.
struct TowardsWaypoint final : Cohesion {
  double weight;  // 1/m

  explicit TowardsWaypoint(double weight_per_m = 1e-5) : weight(weight_per_m) {}

  Eigen::Vector2d anchor(std::span<const Neighbour>,
                         const Eigen::Vector2d& waypoint) const override {
    return waypoint;
  }
  bool needs_waypoint() const override { return true; }
  PlaneValue at(const Eigen::Vector2d& from_anchor) const override {
    return squared_distance(weight, from_anchor);
  }

  static void declare(Options<TowardsWaypoint>& o) {
    o.number("weight", &TowardsWaypoint::weight, "1/m", at_least(0),
             "of the squared distance to it");
  }
};

}  // namespace shoal::formations
