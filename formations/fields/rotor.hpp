#pragma once

#include <Eigen/Core>

#include "shoal/core/options.hpp"
#include "shoal/formations/fields/contours.hpp"
#include "shoal/formations/obstacle.hpp"

namespace shoal::formations {

/// The force across an obstacle's normal that leads a vehicle round it instead of into the local
/// minimum behind it: Barisic et al. 2011, eq. 22-29, with corrections C13-C17. It has no
/// potential.
struct Rotor {
  ObstacleContour contour{.reach_m = 24.0};  ///< A_r; at least the A+ of the obstacles is advisable
  double tie = 1e-3;
  double taper = 0.0;

  /// Which way round, seen from the waypoint.
  struct Turn {
    /// r_i of eq. 28: 1 exactly behind the obstacle, below 0 once it is passed; 0 where the
    /// waypoint is the obstacle's very centre.
    double alignment = 0.0;
    int sense = 0;  ///< 1: counter-clockwise, -1: clockwise, 0: no rotor
  };

  /// `normal`: outward unit vector at the vehicle (C2); places in m, velocity in m/s, all in one
  /// frame.
  Turn turn(const Eigen::Vector2d& normal, const Eigen::Vector2d& obstacle_centre,
            const Eigen::Vector2d& waypoint, const Eigen::Vector2d& velocity) const;

  /// The force per unit of mass, m/s2.
  Eigen::Vector2d force(const Proximity& near, const Turn& turn) const;

  static void declare(Options<Rotor>& o);
};

}  // namespace shoal::formations
