#include "shoal/scenarios/vehicles/nps_auv/controllers.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/angles.hpp"

namespace shoal::scenarios {

void NpsAuvControllers::declare(Options<NpsAuvControllers>& o) {
  using C = NpsAuvControllers;
  o.number("speed_gain_m_s2", &C::speed_gain_m_s2, "m/s^2", at_least(0),
           "eta_u: acceleration against a large error of the speed (the chapter gives none)");
  o.number("speed_layer_m_s", &C::speed_layer_m_s, "m/s", above(0),
           "phi_u: errors of the speed that count as large");
  o.number("propeller_max_rad_s", &C::propeller_max_rad_s, "rad/s", above(0),
           "fastest turn of the propeller");
  o.flag("reverse", &C::reverse, "the propeller may turn backwards");
  o.number("plane_max_rad", &C::plane_max_rad, "rad", in(0, 1.5),
           "largest deflection of rudder and planes");
}

NpsAuvInputs NpsAuvControllers::operator()(const VehicleState& x, const NpsAuvTask& task) const {
  const double v = x(1), r = x(5);
  // (43): v_c is 0, and the printed rho is psi (C38); the sign of v is that of the first line
  // (C39).
  const double sigma =
      -0.074 * v + 0.816 * (r - task.turn_rate_rad_s) + 0.573 * wrapped(x(11) - task.heading_rad);
  const double rudder = 0.033 * v + 0.1112 * r + 2.58 * std::tanh(sigma / 0.1);
  return {.rudder_rad = std::clamp(rudder, -plane_max_rad, plane_max_rad),
          .stern_planes_rad = stern_planes(x, task.depth_m),
          .propeller_rad_s = propeller(x(0), task)};
}

NpsAuvInputs NpsAuvControllers::drifting(const VehicleState& x, double depth_m) const {
  return {.stern_planes_rad = stern_planes(x, depth_m)};
}

double NpsAuvControllers::propeller(double u, const NpsAuvTask& task) const {
  // (41)-(42): u' = -alpha u|u| + alpha beta n|n|, from which beta = (u_0/n_0)^2 (C36) and the
  // signs of alpha (C37) follow.
  static const NpsAuvSurge surge = nps_auv_surge();
  static const double alpha = surge.drag_kg_m / surge.mass_kg;
  constexpr double beta = nps_auv_speed_per_revolution_m * nps_auv_speed_per_revolution_m;
  const double square = (alpha * u * std::abs(u) + task.acceleration_m_s2 -
                         speed_gain_m_s2 * std::tanh((u - task.speed_m_s) / speed_layer_m_s)) /
                        (alpha * beta);
  const double n = std::copysign(std::sqrt(std::abs(square)), square);
  return std::clamp(n, reverse ? -propeller_max_rad_s : 0.0, propeller_max_rad_s);
}

double NpsAuvControllers::stern_planes(const VehicleState& x, double depth_m) const {
  // (44)-(45); q_c and theta_c are 0.
  const double q = x(4), theta = x(10);
  const double sigma = q + 0.520 * theta - 0.011 * (x(8) - depth_m);
  const double planes = -5.143 * q + 1.070 * theta + 4.0 * std::tanh(sigma / 0.4);
  return std::clamp(planes, -plane_max_rad, plane_max_rad);
}

}  // namespace shoal::scenarios
