#pragma once

#include "shoal/scenarios/vehicles/swarm.hpp"

namespace shoal::scenarios {

/// The drag-and-turn-in-place vehicle of the thesis' test-bed (a Folaga).
///
/// Surge: m dv/dt = T - D(v), with D the drag map, linear between knots. It turns at a rate
/// proportional to its heading thrust, whatever its speed, and thrusts ahead only while it points
/// near its course. Source: Rypkema 2015, sec. 4.1, and the configuration of the author's program.
struct Drifter final : public VehicleType {
  double mass_kg = 31.0;
  double drag_n = 26.31;
  double drag_knot_m_s = 0.1;
  double max_speed_m_s = 1.0;
  double turn_rate_deg_s = 18.0;
  double heading_gain = 2.0;
  double heading_damping = 1.0;
  std::int64_t heading_differences = 9;
  double heading_limit_deg = 10.0;
  double heading_noise_deg_s = 0.35;
  double heading_noise_time_s = 200.0;
  double heading_noise_limit_deg_s = 1.0;
  double heading_noise_period_s = 1.0;
  double course_step_deg = 1.0;
  double speed_step_m_s = 0.2;
  double step_s = 0.05;
  double controller_period_s = 0.1;
  double start_depth_m = 0.0;
  double pitch_limit_deg = 20.0;
  double pitch_gain_deg_m = 7.2;

  static void declare(Options<Drifter>& o);
  std::optional<std::string> complaint() const;

  std::optional<std::string> refuses_tick(double tick_s) const override;
  std::unique_ptr<Swarm> launch(const std::vector<Start>& starts, const Energy& energy,
                                const RandomStreams& random, double tick_s) const override;
};

}  // namespace shoal::scenarios
