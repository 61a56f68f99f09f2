#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "shoal/core/registry.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/formations/plane_value.hpp"

namespace shoal::formations {

/// A term of the cost that keeps the swarm together: a function of the displacement from an anchor.
///
/// Stateless and thread-safe.
class Cohesion {
 public:
  static constexpr const char* family = "cohesion";
  static constexpr const char* family_meaning = "term of a cost that keeps the swarm together";

  virtual ~Cohesion() = default;

  /// Where it draws to, in metres, own frame: fixed while one problem is solved. `in_range` holds
  /// at least one neighbour; `waypoint` is in the own frame, too.
  virtual Eigen::Vector2d anchor(std::span<const Neighbour> in_range,
                                 const Eigen::Vector2d& waypoint) const = 0;

  /// True if it draws to the waypoint.
  virtual bool needs_waypoint() const { return false; }

  /// The term at a place `from_anchor` metres away from it, in metres.
  virtual PlaneValue at(const Eigen::Vector2d& from_anchor) const = 0;
};

/// weight |p|^2, with a weight in 1/m.
inline PlaneValue squared_distance(double weight, const Eigen::Vector2d& p) {
  return {weight * p.squaredNorm(), 2.0 * weight * p, 2.0 * weight * Eigen::Matrix2d::Identity()};
}

}  // namespace shoal::formations
