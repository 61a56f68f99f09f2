#pragma once

#include <Eigen/Core>
#include <cmath>

namespace shoal {

/// A rigid motion of the plane, x -> R x + t, kept as the cosine and sine of its angle.
///
/// Variables are named by their frames: `T_own_plan * p_plan` is the point in the own frame.
struct Transform2 {
  double cosine = 1.0;
  double sine = 0.0;
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();  ///< metres

  static Transform2 from_angle(double angle, const Eigen::Vector2d& translation) {
    return {std::cos(angle), std::sin(angle), translation};
  }

  double angle() const { return std::atan2(sine, cosine); }

  Eigen::Vector2d rotate(const Eigen::Vector2d& p) const {
    return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()};
  }

  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const { return rotate(p) + translation; }

  Transform2 operator*(const Transform2& other) const {
    return {cosine * other.cosine - sine * other.sine, sine * other.cosine + cosine * other.sine,
            rotate(other.translation) + translation};
  }

  Transform2 inverse() const {
    const Transform2 back{cosine, -sine, Eigen::Vector2d::Zero()};
    return {cosine, -sine, -back.rotate(translation)};
  }
};

}  // namespace shoal
