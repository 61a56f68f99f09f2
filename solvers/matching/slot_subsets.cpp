#include "shoal/solvers/matching/slot_subsets.hpp"

#include <algorithm>
#include <array>

#include "shoal/core/angles.hpp"
#include "shoal/core/interruption.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

bool coincide(const AlignedSlots& a, const AlignedSlots& b, double angle) {
  check_interruption();
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

SlotSubsets::SlotSubsets(int points, std::span<const Eigen::Vector2d> slots, const SubsetRule& rule,
                         const Turns& turns)
    : points_(points), slots_(slots.begin(), slots.end()), rule_(rule) {
  for (int seed = 0; seed < static_cast<int>(slots_.size()); ++seed) {
    check_interruption();
    SlotSubset subset = around(seed);
    const bool known = std::ranges::any_of(subsets_, [&](const SlotSubset& earlier) {
      return alike(subset.aligned, earlier.aligned, turns);
    });
    if (!known) subsets_.push_back(std::move(subset));
  }
}

bool SlotSubsets::are_of(int points, std::span<const Eigen::Vector2d> slots,
                         const SubsetRule& rule) const {
  return points == points_ && rule == rule_ && std::ranges::equal(slots, slots_);
}

SlotSubset SlotSubsets::around(int seed) const {
  const Eigen::Vector2d& seed_slot = slots_[static_cast<std::size_t>(seed)];
  std::vector<double> distance;
  for (const Eigen::Vector2d& slot : slots_) distance.push_back((slot - seed_slot).norm());
  std::vector<double> sorted = distance;
  std::nth_element(sorted.begin(), sorted.begin() + (points_ - 1), sorted.end());
  const double reach = sorted[static_cast<std::size_t>(points_ - 1)] + rule_.tie_m;

  SlotSubset subset;
  std::vector<Eigen::Vector2d> taken;
  Eigen::Vector2d sum = (rule_.seed_weight - 1.0) * seed_slot;
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    if (distance[j] > reach) continue;
    subset.slot.push_back(static_cast<int>(j));
    taken.push_back(slots_[j]);
    sum += slots_[j];
  }
  const double weight = static_cast<double>(taken.size()) - 1.0 + rule_.seed_weight;
  subset.aligned = AlignedSlots(taken, sum / weight);
  return subset;
}

}  // namespace shoal::solvers
