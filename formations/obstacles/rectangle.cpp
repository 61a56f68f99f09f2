#include <cmath>

#include "shoal/formations/obstacles/oblong.hpp"

namespace shoal::formations {

// Barisic et al. 2011, eq. 48-49, with half sizes throughout (C41, C42) and unit normals (C43).
Proximity Rectangle::nearest_in_quadrant(const Eigen::Vector2d& place, double rounding) const {
  const Eigen::Vector2d q = place - half_;
  const double tolerance = rounding + 1e-15 * half_.maxCoeff();
  const bool in_corner = q.cwiseAbs().maxCoeff() <= tolerance;

  if (q.minCoeff() > 0.0) {  // beyond a corner
    const double d = q.norm();
    return {d, q / d, 1.0 / d, !in_corner};
  }
  if (q.x() >= q.y()) {
    const bool as_near = q.x() < 0.0 && (q.x() - q.y() <= tolerance || place.x() <= tolerance);
    return {q.x(), Eigen::Vector2d::UnitX(), 0.0, !in_corner && !as_near};
  }
  const bool as_near = q.y() < 0.0 && (q.y() - q.x() <= tolerance || place.y() <= tolerance);
  return {q.y(), Eigen::Vector2d::UnitY(), 0.0, !in_corner && !as_near};
}

namespace {

const Register<Obstacle, Oblong<Rectangle>> registered{
    "rectangle", "a turned rectangle (Barisic et al. 2011, eq. 48-49)",
    [](const Oblong<Rectangle>& options) { return options.made(); }};

}  // namespace
}  // namespace shoal::formations
