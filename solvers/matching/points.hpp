#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <span>

namespace shoal::solvers {

/// Above every distance and every sum of distances.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Closer slots (m) are in the same place: far below cost_tie_m, even summed over a swarm, and far
/// above the rounding of coordinates.
inline constexpr double same_place_m = 1e-9;

inline bool all_finite(std::span<const Eigen::Vector2d> points) {
  return std::ranges::all_of(points, [](const Eigen::Vector2d& p) { return p.allFinite(); });
}

}  // namespace shoal::solvers
