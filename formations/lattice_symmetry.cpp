#include "shoal/formations/lattice_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "shoal/core/angles.hpp"

namespace shoal::formations {
namespace {

constexpr double bond_ratio = 1.05;      // bonds are hardly longer than the shortest
constexpr double same_direction = 0.01;  // rad

/// Directions of the bonds between nearest slots, each both ways.
std::vector<double> bonds(const Plan& plan) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < plan.size(); ++i) {
    for (int j = 0; j < i; ++j) {
      shortest = std::min(shortest, (plan.slot(i) - plan.slot(j)).norm());
    }
  }
  std::vector<double> directions;
  for (int i = 0; i < plan.size(); ++i) {
    for (int j = 0; j < plan.size(); ++j) {
      const Eigen::Vector2d bond = plan.slot(j) - plan.slot(i);
      if (i == j || bond.norm() > bond_ratio * shortest) continue;
      const double direction = std::atan2(bond.y(), bond.x());
      const bool known = std::ranges::any_of(directions, [&](double other) {
        return std::abs(wrapped(direction - other)) < same_direction;
      });
      if (!known) directions.push_back(direction);
    }
  }
  return directions;
}

}  // namespace

int lattice_symmetry(const Plan& plan) {
  const std::vector<double> directions = bonds(plan);
  if (directions.empty()) return 1;
  for (const int order : {6, 4}) {
    const double turn = 2.0 * std::numbers::pi / order;
    const bool mapped = std::ranges::all_of(directions, [&](double direction) {
      return std::ranges::any_of(directions, [&](double other) {
        return std::abs(wrapped(direction + turn - other)) < same_direction;
      });
    });
    if (mapped) return order;
  }
  return 2;
}

}  // namespace shoal::formations
