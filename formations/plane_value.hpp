#pragma once

#include <Eigen/Core>

namespace shoal::formations {

/// A function of one distance: value, first and second derivative with respect to it.
struct RadialValue {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

/// A function at one place of the plane, with its derivatives with respect to x and y (m).
struct PlaneValue {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();

  PlaneValue& operator+=(const PlaneValue& other) {
    value += other.value;
    gradient += other.gradient;
    hessian += other.hessian;
    return *this;
  }
};

/// p(d(x)) of a distance with the gradient `normal` and the Hessian `bend` (I - n n^T), where bend
/// (1/m) is the curvature of the line of equal distance.
inline PlaneValue of_distance(const RadialValue& p, const Eigen::Vector2d& normal, double bend) {
  const Eigen::Matrix2d along = normal * normal.transpose();
  return {p.value, p.slope * normal,
          p.curvature * along + p.slope * bend * (Eigen::Matrix2d::Identity() - along)};
}

/// p(|r|) of a displacement r (m), of a p that is flat at zero.
inline PlaneValue of_displacement(const RadialValue& p, const Eigen::Vector2d& r) {
  const double d = r.norm();
  if (d > 0.0) return of_distance(p, r / d, 1.0 / d);
  return {p.value, Eigen::Vector2d::Zero(), p.curvature * Eigen::Matrix2d::Identity()};
}

}  // namespace shoal::formations
