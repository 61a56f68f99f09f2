#include "shoal/formations/obstacles/outline.hpp"

#include <cmath>
#include <numbers>

namespace shoal::formations {
namespace {

/// Where a ray from the centre leaves the obstacle: no point nearer than the edge's distance is
/// beyond it, so that one may go as far at a time.
Eigen::Vector2d edge_towards(const Obstacle& obstacle, double angle) {
  const Eigen::Vector2d centre = obstacle.centre();
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  double gone = 0.0;
  for (int k = 0; k < 500; ++k) {
    const double left = -obstacle.nearest(centre + gone * along).distance;
    if (left <= 1e-6) break;
    gone += left;
  }
  return centre + gone * along;
}

/// Adds what lies between two directions, without either, until chords follow the edge.
void refine(const Obstacle& obstacle, double from, const Eigen::Vector2d& first, double to,
            const Eigen::Vector2d& last, int depth, std::vector<Eigen::Vector2d>& polygon) {
  const double middle = 0.5 * (from + to);
  const Eigen::Vector2d edge = edge_towards(obstacle, middle);
  const Eigen::Vector2d chord = last - first;
  const Eigen::Vector2d off = edge - first;
  const double away =
      std::abs(chord.x() * off.y() - chord.y() * off.x()) / std::max(chord.norm(), 1e-12);
  const double size = (edge - obstacle.centre()).norm();
  if (depth > 10 || away <= 1e-3 * size) return;
  refine(obstacle, from, first, middle, edge, depth + 1, polygon);
  polygon.push_back(edge);
  refine(obstacle, middle, edge, to, last, depth + 1, polygon);
}

}  // namespace

std::vector<Eigen::Vector2d> outline(const Obstacle& obstacle) {
  constexpr int directions = 24;
  constexpr double turn = 2.0 * std::numbers::pi / directions;
  std::vector<Eigen::Vector2d> polygon;
  for (int k = 0; k < directions; ++k) {
    const Eigen::Vector2d here = edge_towards(obstacle, k * turn);
    polygon.push_back(here);
    refine(obstacle, k * turn, here, (k + 1) * turn, edge_towards(obstacle, (k + 1) * turn), 0,
           polygon);
  }
  return polygon;
}

}  // namespace shoal::formations
