#pragma once

#include <cmath>
#include <memory>

#include "shoal/formations/planner.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations::tests {

inline Ping ping_of(const Neighbour& n, double time_s) {
  return {.time_s = time_s,
          .range_m = n.position.norm(),
          .bearing_rad = std::atan2(n.position.y(), n.position.x()),
          .slot = n.slot};
}

/// A planner of vehicle v0, and what its own frame's origin stands for.
struct Engineer {
  std::shared_ptr<const Plan> plan;
  Planner planner;

  explicit Engineer(const Plan& geometry, const char* kind = "rigid_registration")
      : plan(std::make_shared<const Plan>(geometry)),
        planner(plan, std::shared_ptr<const Behaviour>(behaviour(kind)), "v0") {}

  void hear(const Neighbours& all, double time_s, const Vector2d& own) {
    for (const Neighbour& n : all) planner.receive(ping_of(n, time_s), own);
  }
};

inline const Vector2d start(5000, -2000);

inline std::shared_ptr<const Plan> shared(const Plan& plan) {
  return std::make_shared<const Plan>(plan);
}

}  // namespace shoal::formations::tests
