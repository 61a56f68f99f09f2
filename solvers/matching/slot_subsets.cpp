#include "shoal/solvers/matching/slot_subsets.hpp"

#include <algorithm>
#include <array>

#include "shoal/core/angles.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

bool coincide(const AlignedSlots& a, const AlignedSlots& b, double angle) {
  const Transform2 turned = Transform2::from_angle(angle, Eigen::Vector2d::Zero());
  for (Eigen::Index i = 0; i < a.x.size(); ++i) {
    const Eigen::Vector2d p = turned * Eigen::Vector2d(a.x[i], a.y[i]);
    const double nearest = ((b.x - p.x()).square() + (b.y - p.y()).square()).minCoeff();
    if (nearest > same_place_m * same_place_m) return false;
  }
  return true;
}

bool alike(const AlignedSlots& a, const AlignedSlots& b, const Turns& turns) {
  if (a.size() != b.size() || ((a.radius - b.radius).abs() > same_place_m).any()) return false;
  constexpr std::array lattice_rotations_deg{0.0, 60.0, 90.0, 120.0, 180.0, 240.0, 270.0, 300.0};
  return std::ranges::any_of(lattice_rotations_deg, [&](double angle_deg) {
    return turns.permuted_by(angle_deg) && coincide(a, b, radians(angle_deg));
  });
}

}  // namespace

const std::vector<SlotSubset>& SlotSubsets::of(int points, std::span<const Eigen::Vector2d> slots,
                                               const SubsetRule& rule, const Turns& turns) {
  if (!std::ranges::equal(slots, slots_) || rule != rule_ || turns.step_deg() != step_deg_) {
    slots_.assign(slots.begin(), slots.end());
    rule_ = rule;
    step_deg_ = turns.step_deg();
    by_points_.assign(slots.size() + 1, {});
    ++edition_;
  }
  std::vector<SlotSubset>& subsets = by_points_[static_cast<std::size_t>(points)];
  if (!subsets.empty()) return subsets;

  for (int seed = 0; seed < static_cast<int>(slots_.size()); ++seed) {
    SlotSubset subset = around(seed, points);
    const bool known = std::ranges::any_of(subsets, [&](const SlotSubset& earlier) {
      return alike(subset.aligned, earlier.aligned, turns);
    });
    if (!known) subsets.push_back(std::move(subset));
  }
  return subsets;
}

SlotSubset SlotSubsets::around(int seed, int points) {
  const Eigen::Vector2d& seed_slot = slots_[static_cast<std::size_t>(seed)];
  distance_.clear();
  for (const Eigen::Vector2d& slot : slots_) distance_.push_back((slot - seed_slot).norm());
  sorted_ = distance_;
  std::nth_element(sorted_.begin(), sorted_.begin() + (points - 1), sorted_.end());
  const double reach = sorted_[static_cast<std::size_t>(points - 1)] + rule_.tie_m;

  SlotSubset subset;
  std::vector<Eigen::Vector2d> taken;
  Eigen::Vector2d sum = (rule_.seed_weight - 1.0) * seed_slot;
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    if (distance_[j] > reach) continue;
    subset.slot.push_back(static_cast<int>(j));
    taken.push_back(slots_[j]);
    sum += slots_[j];
  }
  const double weight = static_cast<double>(taken.size()) - 1.0 + rule_.seed_weight;
  subset.aligned = AlignedSlots(taken, sum / weight);
  return subset;
}

}  // namespace shoal::solvers
