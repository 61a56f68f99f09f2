#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shoal/solvers/matching/assignment.hpp"
#include "shoal/solvers/matching/paired_distances.hpp"
#include "shoal/solvers/matching/pose_box.hpp"
#include "shoal/solvers/matching/slot_field.hpp"

namespace shoal::solvers {

/// Branch and bound over the rigid motions that lay points onto slots, one slot of its own for each
/// point, so that the sum of distances (m) is least; best bound first.
///
/// A box of motions takes each point into a disc. Lower bounds close boxes:
/// - whatever the angle, the points are as near to their centroid as they are, and that to slots;
/// - every point meets its nearest slot (SlotField);
/// - the prices of an optimal assignment of the middles of the discs;
/// - the least sum over all motions (PairedDistances) of each of the few assignments that may be
///   optimal for points in their discs. Near the optimum the others would need ever smaller boxes;
///   this one closes a whole neighbourhood at once.
///
/// Deterministic. Keeps its work space between calls: one object per thread.
class PoseSearch {
 public:
  struct Best {
    RigidPose pose;
    double sum = std::numeric_limits<double>::infinity();
    std::vector<int> slot_of_point;  ///< empty as long as the ceiling stands
  };

  /// Slots in metres, finite, at least one; the tolerance is on the mean distance.
  PoseSearch(std::span<const Eigen::Vector2d> slots, double tolerance_m);

  /// About their centroid, finite, at least one and not more than slots. Only sums below `ceiling`
  /// are looked for.
  void set_points(std::span<const Eigen::Vector2d> points,
                  double ceiling = std::numeric_limits<double>::infinity());

  /// The optimal assignment there, its best motion, the optimal assignment there, and so on.
  void try_pose(const RigidPose& pose);

  /// No motion outside of it has a sum as low as the best.
  PoseBox promising() const;

  /// Looks for better ones in a region until the best is so to the tolerance, or the work reaches a
  /// limit. No motion of the region has a sum below what is returned.
  double search(const PoseBox& region, std::int64_t most_work);

  const Best& best() const { return best_; }
  const std::vector<Eigen::Vector2d>& slots() const { return slots_; }

  /// How many distances were looked at so far: the work, on any machine.
  std::int64_t work() const;

 private:
  /// An assignment whose least sum over motions is known, or will be if it is asked for. Those that
  /// differ by a shift along the plan only are the same.
  struct Known {
    std::vector<Eigen::Vector2d> targets;  // from the first
    RigidPose pose;                        // that lays the points onto these
    double sum = 0.0;
    double bound_below = 0.0;
    bool certified = false;
  };

  double slack() const { return tolerance_m_ * static_cast<double>(points_.size()); }
  double limit() const { return best_.sum - slack(); }

  void place_discs(const PoseBox& box);
  void glance(PoseBox& box);
  void look(PoseBox& box);
  void assign();
  double bound_of_all_angles(const PoseBox& box);
  double bound_of_discs() const;
  double least_change();
  bool list_rivals(double room);
  bool list_rivals_from(std::size_t row, double room);
  std::size_t known(std::span<const int> slot_of, const RigidPose& pose);
  double certified_sum(std::size_t index, std::span<const int> slot_of);

  double tolerance_m_;
  std::vector<Eigen::Vector2d> slots_;
  Eigen::ArrayXd slot_x_, slot_y_;
  SlotField field_;
  double spacing_m_;  // an assignment tells most once the discs are smaller

  std::vector<Eigen::Vector2d> points_;
  std::vector<double> radius_;  // of the points
  double mean_radius_ = 0.0, farthest_ = 0.0;
  std::vector<Eigen::Vector2d> discs_, targets_;
  std::vector<double> disc_radius_, costs_, reduced_;
  std::vector<std::vector<int>> rivals_;
  std::vector<int> partial_, first_;
  std::vector<bool> taken_;
  std::size_t rivals_count_ = 0;
  int tries_ = 0;
  AssignmentSolver assignment_;
  PairedDistances pairs_;
  std::vector<Known> known_;
  std::size_t known_count_ = 0;
  Best best_;
  std::vector<PoseBox> open_;
  std::int64_t serial_ = 0, looked_at_ = 0;
};

}  // namespace shoal::solvers
