#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace shoal::solvers {

/// A rigid motion of the plane: p is laid onto R(angle) p + place (rad, metres).
struct RigidPose {
  double angle = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};

/// The sum of the distances (m) between points, moved rigidly, and one target each.
///
/// Like a registration, but for distances instead of their squares: there is no closed form, and
/// there may be several minima. For a rotation held fixed the sum is convex in the translation, so
/// that unit vectors y_i with sum zero prove sum_i |R p_i + t - w_i| >= sum_i y_i . (R p_i - w_i)
/// for every t: a sine in the angle. A few of these bound the sum over all motions.
///
/// Keeps its work space between calls: one object per thread.
class PairedDistances {
 public:
  struct Least {
    RigidPose pose;
    double sum = 0.0;          ///< at that pose
    double bound_below = 0.0;  ///< no motion has a lower sum
  };

  /// Equally many, at least one; points with their centroid near the origin.
  void set(std::span<const Eigen::Vector2d> points, std::span<const Eigen::Vector2d> targets);

  double sum(const RigidPose& pose) const;

  /// The local minimum that a descent reaches from there.
  RigidPose descended(const RigidPose& start) { return descended(start, true); }

  /// The global minimum; its bound is at most `slack` (m) lower, unless rounding or a limit on the
  /// number of arcs ends the search first.
  Least least(const RigidPose& start, double slack);

  /// How many distances were looked at so far, by whatever call.
  std::int64_t work() const { return work_; }

 private:
  /// cosine * cos(angle) + sine * sin(angle) - offset.
  struct Sine {
    double cosine, sine, offset;

    double least_on(double angle, double half_width) const;
  };
  struct Derivatives;

  RigidPose descended(RigidPose pose, bool turning);
  RigidPose descended(RigidPose pose, bool turning, double softening_m, double least_gain);
  Derivatives derivatives(const RigidPose& pose, bool turning, double softening_m);
  double softened_sum(const RigidPose& pose, double softening_m);
  Sine bound_at(const RigidPose& pose);
  double bound_on(double angle, double half_width) const;

  std::span<const Eigen::Vector2d> points_, targets_;
  double radius_ = 1.0;  // rms of the points, m: makes an angle a length
  std::vector<Sine> sines_;
  std::vector<Eigen::Vector2d> duals_;
  mutable std::int64_t work_ = 0;
};

}  // namespace shoal::solvers
