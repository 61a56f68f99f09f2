#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/paired_distances.hpp"

namespace shoal::solvers {

/// All rigid motions whose angle and place are within an interval each.
struct PoseBox {
  RigidPose middle;
  double arc = std::numbers::pi;                   ///< half of the interval of angles, rad
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  ///< half of its sides, m
  double bound = 0.0;                              ///< no motion of the box has a lower sum, m
  std::int64_t serial = 0;                         ///< the order in which boxes were made
  bool nearest_suffice = false;  ///< the nearest slots alone rule its middle out, if not the box

  /// Every motion of the box takes p into the disc about discs() * p, which is no rigid motion, of
  /// radius |p| spread() + reach().
  Transform2 discs() const {
    const double scale = std::cos(std::min(arc, 0.5 * std::numbers::pi));
    return {scale * std::cos(middle.angle), scale * std::sin(middle.angle), middle.place};
  }
  double spread() const { return std::sin(std::min(arc, 0.5 * std::numbers::pi)); }
  double reach() const { return half.norm(); }

  /// Halves, along what shrinks the discs of points `radius` (m) from the origin most.
  std::pair<PoseBox, PoseBox> split(double radius) const;
};

}  // namespace shoal::solvers
