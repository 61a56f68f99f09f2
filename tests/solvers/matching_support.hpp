#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/assignment.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"

namespace shoal::solvers::tests {

inline std::vector<Eigen::Vector2d> lattice(int columns, int rows, double separation_m) {
  std::vector<Eigen::Vector2d> slots;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) slots.emplace_back(separation_m * i, -separation_m * j);
  }
  return slots;
}

inline std::vector<Eigen::Vector2d> centred(std::vector<Eigen::Vector2d> points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  for (auto& p : points) p -= mean;
  return points;
}

inline std::vector<Eigen::Vector2d> moved(std::vector<Eigen::Vector2d> points,
                                          const Transform2& motion) {
  for (auto& p : points) p = motion * p;
  return points;
}

/// Of the points turned by `angle` (rad) on the slots.
inline double assignment_cost(const std::vector<Eigen::Vector2d>& points,
                              const std::vector<Eigen::Vector2d>& slots, double angle) {
  std::vector<double> costs;
  for (const auto& p : moved(points, Transform2::from_angle(angle, {0, 0}))) {
    for (const auto& slot : slots) costs.push_back((p - slot).norm());
  }
  AssignmentSolver solver;
  solver.solve(costs, static_cast<int>(points.size()), static_cast<int>(slots.size()));
  return solver.cost();
}

inline TurnedMatch first_of_the_least(const std::vector<double>& costs) {
  const double least = *std::min_element(costs.begin(), costs.end());
  for (std::size_t i = 0;; ++i) {
    if (costs[i] <= least + cost_tie_m) return {static_cast<int>(i), costs[i]};
  }
}

}  // namespace shoal::solvers::tests
