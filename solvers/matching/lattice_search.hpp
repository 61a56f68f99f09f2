#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shoal/solvers/matching/pose_search.hpp"
#include "shoal/solvers/matching/slot_lattice.hpp"

namespace shoal::solvers {

/// The search for the best motion of points onto an infinite lattice that the slots of a plan are
/// part of.
///
/// With more slots than the plan has, no sum of distances gets greater: its least sum bounds that
/// of the plan from below. And it is soon found, as shifts by one cell and turns by the lattice's
/// symmetry change nothing. The part of the lattice near the points stands for all of it, as long
/// as a slot outside of it would cost more than the best.
class LatticeSearch {
 public:
  /// Nothing for slots that are part of no lattice.
  static std::optional<LatticeSearch> of(std::span<const Eigen::Vector2d> slots,
                                         double tolerance_m);

  /// The points that `plan` was given and the best so far of its slots, which may get better: where
  /// the best on the lattice fits the plan. Returns a lower bound
  /// of their sum of distances. `budget`: how much work may be spent.
  double search(std::span<const Eigen::Vector2d> points, PoseSearch& plan, std::int64_t budget);

  std::int64_t work() const { return work_before_ + (window_ ? window_->work() : 0); }

 private:
  LatticeSearch(const SlotLattice& lattice, std::span<const Eigen::Vector2d> slots,
                double tolerance_m);
  void cover(double radius_m);
  std::optional<RigidPose> fitted(std::span<const Eigen::Vector2d> slots) const;

  SlotLattice lattice_;
  double tolerance_m_, width_m_, height_m_;  // of a rectangle that tiles the plane like a cell
  std::vector<Eigen::Vector2i> cell_of_slot_;
  std::optional<PoseSearch> window_;  // the lattice near its origin, a along x
  double window_radius_m_ = 0.0;
  std::int64_t work_before_ = 0;
};

}  // namespace shoal::solvers
