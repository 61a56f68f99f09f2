#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "shoal/core/registry.hpp"
#include "shoal/formations/obstacle.hpp"
#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/starts/start.hpp"

namespace shoal::scenarios {

/// An obstacle of a scenario: `[[obstacle]]` in its file.
struct ObstacleOptions {
  Choice<formations::Obstacle> shape{"circle"};
  Origin origin;

  static void declare(Options<ObstacleOptions>& o);
};

std::vector<std::shared_ptr<const formations::Obstacle>> make_obstacles(
    const std::vector<ObstacleOptions>& options);

/// Throws InputError, pointing at the obstacle, if one covers a start or the waypoint.
void require_clear(const std::vector<ObstacleOptions>& options, const std::vector<Start>& starts,
                   const formations::Plan& plan, const std::optional<Eigen::Vector2d>& waypoint);

}  // namespace shoal::scenarios
