#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "shoal/core/registry.hpp"

namespace shoal::formations {

/// The nearest point of an obstacle's edge, as seen from a place.
struct Proximity {
  double distance = 0.0;                              ///< m; negative inside
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< outward unit vector: grad distance
  /// Of the line of equal distance, 1/m: the Hessian of the distance is
  /// curvature (I - normal normal^T). Zero where that line shrinks to a point.
  double curvature = 0.0;
  /// False where, to rounding, several points are nearest or the edge has a corner; `distance` is
  /// right there, too, and `normal` is one of the possible ones (the shapes say which).
  bool unique = true;

  /// The nearest point of the edge, seen from `place` (m).
  Eigen::Vector2d closest(const Eigen::Vector2d& place) const { return place - distance * normal; }
};

/// A shape in the plane that vehicles keep clear of: Barisic et al. 2011, sec. 5.1.
///
/// Metres east and north, in the frame of the own positions. Immutable and thread-safe.
class Obstacle {
 public:
  static constexpr const char* family = "obstacle";
  static constexpr const char* family_meaning = "shape that vehicles keep clear of";

  virtual ~Obstacle() = default;
  virtual Eigen::Vector2d centre() const = 0;
  virtual Proximity nearest(const Eigen::Vector2d& place) const = 0;

 protected:
  Obstacle() = default;
  Obstacle(const Obstacle&) = default;
  Obstacle& operator=(const Obstacle&) = default;
};

/// Obstacles that are owned elsewhere.
using Obstacles = std::span<const std::shared_ptr<const Obstacle>>;

}  // namespace shoal::formations
