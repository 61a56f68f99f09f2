#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/formations/obstacles/shapes.hpp"

namespace shoal::formations {

TurnedShape::TurnedShape(const Eigen::Vector2d& centre, double angle)
    : centre_(centre), axis_(std::cos(angle), std::sin(angle)) {}

// X = R(psi)^T (x - x_i); the normal comes back turned only (C40: the printed inverse of T_i would
// move it, too). sign(0) = +1.
Proximity TurnedShape::nearest(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d from_centre = place - centre_;
  const Eigen::Vector2d there(axis_.dot(from_centre),
                              axis_.x() * from_centre.y() - axis_.y() * from_centre.x());
  const double size = std::max(place.cwiseAbs().maxCoeff(), centre_.cwiseAbs().maxCoeff());
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * size;

  Proximity near = nearest_in_quadrant(there.cwiseAbs(), rounding);
  const Eigen::Vector2d n(there.x() < 0.0 ? -near.normal.x() : near.normal.x(),
                          there.y() < 0.0 ? -near.normal.y() : near.normal.y());
  near.normal = {axis_.x() * n.x() - axis_.y() * n.y(), axis_.y() * n.x() + axis_.x() * n.y()};
  return near;
}

}  // namespace shoal::formations
