#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "shoal/solvers/matching/rotation_search.hpp"

namespace shoal::solvers {

/// A part of a plan that a group of vehicles may take: a seed slot and the slots nearest to it.
struct SlotSubset {
  std::vector<int> slot;  ///< indices in the plan, ascending
  AlignedSlots aligned;   ///< the same slots about their centre, metres
};

/// How subsets are made and aligned.
struct SubsetRule {
  double tie_m = 0.5;        ///< as far as the last one taken, within this: taken too
  double seed_weight = 1.0;  ///< of the seed in the centre of the subset; the others weigh 1

  bool operator==(const SubsetRule&) const = default;
};

/// The subsets of a plan worth searching, per number of points (Rypkema 2015, sec. 3.7, step 2).
///
/// They depend on the plan only, so they are kept from call to call and made anew when the plan,
/// the rule or the step changes. Of subsets that look alike about their centres, also after a
/// rotation that only permutes the turns, the first stands for all: their costs are the same, and
/// the first would win (the augmentation that sec. 3.7 suggests for lattices).
class SlotSubsets {
 public:
  /// Subsets of at least `points` slots, ordered by their seeds. 1 <= points <= slots.size().
  const std::vector<SlotSubset>& of(int points, std::span<const Eigen::Vector2d> slots,
                                    const SubsetRule& rule, const Turns& turns);

  /// Another number whenever the plan, the rule or the step has changed; above 0.
  std::int64_t edition() const { return edition_; }

 private:
  SlotSubset around(int seed, int points);

  std::vector<Eigen::Vector2d> slots_;
  SubsetRule rule_;
  double step_deg_ = 0.0;
  std::int64_t edition_ = 0;
  std::vector<std::vector<SlotSubset>> by_points_;
  std::vector<double> distance_, sorted_;
};

}  // namespace shoal::solvers
