#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>

#include "shoal/core/transform.hpp"

namespace shoal::solvers {

enum class RegistrationStatus : std::uint8_t {
  fitted,
  translation_only,  ///< the points do not fix the rotation (fewer than two distinct ones)
  bad_input,         ///< no points, no positive weight, or not finite
};
std::string_view name_of(RegistrationStatus status);

struct RegistrationSolution {
  Transform2 T_to_from;  ///< takes `from` points to `to` points; the identity rotation if unfixed
  double cost = 0.0;     ///< weighted sum of squared residuals, m^2
  RegistrationStatus status = RegistrationStatus::bad_input;

  bool usable() const { return status != RegistrationStatus::bad_input; }
};

/// Weighted sums of matched pairs, from which the best rigid motion follows in closed form.
///
/// Minimises sum w |R from + t - to|^2 over rotations and translations (never reflections):
/// Rypkema 2015, eq. 3.8. In the plane the singular value decomposition of his steps 3-5 reduces
/// to one angle, atan2(sum w from x to, sum w from . to) of the centred points.
class Procrustes {
 public:
  /// A pair of weight zero does not count; a negative weight makes the whole a bad input.
  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight);
  RegistrationSolution solve() const;

 private:
  // The first pair that counts is the origin of the sums, so that far-away swarms lose no digits.
  Eigen::Vector2d from_origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d from_sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_sum_ = Eigen::Vector2d::Zero();
  double weight_ = 0.0, dot_ = 0.0, cross_ = 0.0, from_squared_ = 0.0, to_squared_ = 0.0;
  bool any_ = false, bad_ = false;
};

inline void Procrustes::add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight) {
  if (!(weight > 0.0)) {
    bad_ = bad_ || weight != 0.0;
    return;
  }
  if (!any_) {
    any_ = true;
    from_origin_ = from;
    to_origin_ = to;
  }
  const Eigen::Vector2d f = from - from_origin_;
  const Eigen::Vector2d t = to - to_origin_;
  weight_ += weight;
  from_sum_ += weight * f;
  to_sum_ += weight * t;
  dot_ += weight * (f.x() * t.x() + f.y() * t.y());
  cross_ += weight * (f.x() * t.y() - f.y() * t.x());
  from_squared_ += weight * f.squaredNorm();
  to_squared_ += weight * t.squaredNorm();
}

}  // namespace shoal::solvers
