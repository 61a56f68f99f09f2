#include "shoal/formations/fields/contours.hpp"

#include <cmath>

namespace shoal::formations {

RadialValue ObstacleContour::at(double d) const {
  const double held = std::max(d, nearest_m());
  const double q = reach_m / held;
  const double grown = strength_m2_s2 * std::exp(q);
  const double slope = -grown * q / held;
  if (d < held) return {grown - strength_m2_s2 + slope * (d - held), slope, 0.0};
  return {strength_m2_s2 * std::expm1(q), slope, grown * q * (2.0 + q) / (held * held)};
}

double ObstacleContour::push(double d) const {
  const double held = std::max(d, nearest_m());
  const double q = reach_m / held;
  return strength_m2_s2 * std::exp(q) * q / held;
}

// The slope is the lesser of A_p d and A_0; eq. 10 prints the greater (C5).
RadialValue WaypointContour::at(double d) const {
  const double stiffness = pull_m_s2 / near_m;  // A_p, 1/s2
  if (d <= near_m) return {0.5 * stiffness * d * d, stiffness * d, stiffness};
  return {pull_m_s2 * (d - 0.5 * near_m), pull_m_s2, 0.0};
}

RadialValue VertexContour::at(double d) const {
  const double q = d / width_m;
  const double bell = std::exp(0.5 * (1.0 - q * q));
  return {-pull_m_s2 * width_m * bell, pull_m_s2 * q * bell,
          pull_m_s2 / width_m * (1.0 - q * q) * bell};
}

void ObstacleContour::declare(Options<ObstacleContour>& o) {
  using C = ObstacleContour;
  o.number("reach_m", &C::reach_m, "m", above(0), "A: the force is k A/d^2 exp(A/d)");
  o.number("strength_m2_s2", &C::strength_m2_s2, "m2/s2", at_least(0), "k of that force");
}

void WaypointContour::declare(Options<WaypointContour>& o) {
  using C = WaypointContour;
  o.number("pull_m_s2", &C::pull_m_s2, "m/s2", at_least(0), "A_0: the force from afar");
  o.number("near_m", &C::near_m, "m", above(0), "within it, the force falls with the distance");
}

void VertexContour::declare(Options<VertexContour>& o) {
  using C = VertexContour;
  o.number("pull_m_s2", &C::pull_m_s2, "m/s2", at_least(0), "A_c: the greatest force");
  o.number("width_m", &C::width_m, "m", above(0), "d_c: where the force is greatest");
}

}  // namespace shoal::formations
