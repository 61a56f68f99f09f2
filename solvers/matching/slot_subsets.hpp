#pragma once

#include <Eigen/Core>
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

/// The subsets of a plan worth searching, for a number of points (Rypkema 2015, sec. 3.7, step 2).
///
/// Of subsets that look alike about their centres, also after a rotation that only permutes the
/// turns, the first stands for all: their costs are the same, and the first would win (the
/// augmentation that sec. 3.7 suggests for lattices).
class SlotSubsets {
 public:
  /// Subsets of at least `points` slots, ordered by their seeds. 1 <= points <= slots.size().
  SlotSubsets(int points, std::span<const Eigen::Vector2d> slots, const SubsetRule& rule,
              const Turns& turns);

  bool are_of(int points, std::span<const Eigen::Vector2d> slots, const SubsetRule& rule) const;
  std::span<const SlotSubset> all() const { return subsets_; }

 private:
  SlotSubset around(int seed) const;

  int points_;
  std::vector<Eigen::Vector2d> slots_;
  SubsetRule rule_;
  std::vector<SlotSubset> subsets_;
};

}  // namespace shoal::solvers
