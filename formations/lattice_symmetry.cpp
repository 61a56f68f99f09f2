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

double angle_of(const Eigen::Vector2d& bond) {
  return std::atan2(bond.y(), bond.x());
}

/// Calls `visit(from, to)` for every two slots that are at most `reach` (m) apart along x; that may
/// shrink meanwhile. Slots must be sorted by x.
template <class Visit>
void pairs_within(const std::vector<Eigen::Vector2d>& slots, const double& reach, Visit visit) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size() && slots[j].x() - slots[i].x() <= reach; ++j) {
      visit(slots[i], slots[j]);
    }
  }
}

/// Directions of the bonds between nearest slots, each both ways.
std::vector<double> bonds(const Plan& plan) {
  std::vector<Eigen::Vector2d> slots(plan.slots().begin(), plan.slots().end());
  std::ranges::sort(slots, {}, [](const Eigen::Vector2d& slot) { return slot.x(); });
  double shortest = std::numeric_limits<double>::infinity();
  pairs_within(slots, shortest, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    shortest = std::min(shortest, (to - from).norm());
  });
  std::vector<double> directions;
  const double longest = bond_ratio * shortest;
  pairs_within(slots, longest, [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d bond = to - from;
    if (bond.norm() > longest) return;
    for (const double direction : {angle_of(bond), angle_of(-bond)}) {
      const bool known = std::ranges::any_of(directions, [&](double other) {
        return std::abs(wrapped(direction - other)) < same_direction;
      });
      if (!known) directions.push_back(direction);
    }
  });
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
