#include "shoal/analysis/measure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace shoal::analysis {

std::optional<double> Results::at(std::string_view name) const {
  for (const auto& [known, value] : values) {
    if (known == name) return value;
  }
  throw std::out_of_range("no measure is called " + std::string(name));
}

double Measure::log_interval_s(const scenarios::World& world) {
  const double tick = world.scenario().trial.tick_s;
  return tick * std::max(1.0, std::round(5.0 / tick));
}

void survivors(const scenarios::World& world, std::vector<Eigen::Vector2d>& positions,
               std::vector<int>& slots) {
  positions.clear();
  slots.clear();
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (world.lost(i)) continue;
    positions.emplace_back(world.swarm().x_m[i], world.swarm().y_m[i]);
    slots.push_back(static_cast<int>(i));
  }
}

Eigen::Vector2d mean_of(const std::vector<Eigen::Vector2d>& points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d::Zero().eval());
  return sum / static_cast<double>(points.size());
}

}  // namespace shoal::analysis
