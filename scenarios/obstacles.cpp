#include "shoal/scenarios/obstacles.hpp"

#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

std::string place(const Eigen::Vector2d& p) {
  return "(" + shortest(p.x()) + ", " + shortest(p.y()) + ")";
}

}  // namespace

void ObstacleOptions::declare(Options<ObstacleOptions>& o) {
  o.choice("shape", &ObstacleOptions::shape, "where it is and what it looks like");
}

std::vector<std::shared_ptr<const formations::Obstacle>> make_obstacles(
    const std::vector<ObstacleOptions>& options) {
  std::vector<std::shared_ptr<const formations::Obstacle>> obstacles;
  for (const ObstacleOptions& obstacle : options) obstacles.push_back(obstacle.shape.make());
  return obstacles;
}

void require_clear(const std::vector<ObstacleOptions>& options, const std::vector<Start>& starts,
                   const formations::Plan& plan, const std::optional<Eigen::Vector2d>& waypoint) {
  const auto obstacles = make_obstacles(options);
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const auto refuse = [&](const std::string& what) {
      throw InputError(options[k].origin, "obstacle " + std::to_string(k + 1) + " (" +
                                              options[k].shape.kind() + ") covers " + what +
                                              "; move one of the two");
    };
    const auto covers = [&](const Eigen::Vector2d& p) {
      return obstacles[k]->nearest(p).distance <= 0.0;
    };
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Eigen::Vector2d start(starts[i].x_m, starts[i].y_m);
      if (covers(start)) {
        refuse("the start of " + plan.name(static_cast<int>(i)) + " at " + place(start));
      }
    }
    if (waypoint && covers(*waypoint)) refuse("the waypoint at " + place(*waypoint));
  }
}

}  // namespace shoal::scenarios
