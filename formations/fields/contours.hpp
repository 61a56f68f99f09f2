#pragma once

#include <algorithm>

#include "shoal/core/options.hpp"
#include "shoal/formations/plane_value.hpp"

namespace shoal::formations {

// The potentials of Barisic et al. 2011 as functions of a distance (m): in m2/s2, their slopes in
// m/s2, a force per unit of mass. What C and a number mean: notebooks/corrections.md.

/// An obstacle, eq. 6: p_o = k_o (exp(A+/d) - 1), with k_o made explicit (C4).
///
/// Nearer than nearest_m(), and inside, it goes on along its tangent: the push is that of
/// nearest_m(), whose exponent is 30 at most, and points out of the obstacle.
struct ObstacleContour {
  double reach_m = 18.0;        ///< A+
  double strength_m2_s2 = 1.0;  ///< k_o

  double nearest_m() const { return std::max(0.5, reach_m / 30.0); }
  RadialValue at(double d) const;
  /// -p_o', eq. 7 (C3): what keeps a vehicle off.
  double push(double d) const;

  static void declare(Options<ObstacleContour>& o);
};

/// A waypoint, eq. 8-10: quadratic within d_0 = A_0/A_p (C6), linear beyond; continuously
/// differentiable.
struct WaypointContour {
  double pull_m_s2 = 0.05;  ///< A_0
  double near_m = 60.0;     ///< d_0

  RadialValue at(double d) const;

  static void declare(Options<WaypointContour>& o);
};

/// A vertex of a formation cell, eq. 11-16, with the exponent of C7, by which A_c is the greatest
/// slope, at d_c, and with the depth of C8.
struct VertexContour {
  double pull_m_s2 = 0.05;  ///< A_c
  double width_m = 10.0;    ///< d_c

  RadialValue at(double d) const;

  static void declare(Options<VertexContour>& o);
};

}  // namespace shoal::formations
