#pragma once

#include <cmath>

#include "shoal/core/options.hpp"

namespace shoal::scenarios {

/// What the vehicle's consumers draw: Rypkema 2015, sec. 4.1.1, eq. 4.1-4.4, Table 4.1.
///
/// The shaft power is c_d |v|^3, the electrical power that over the efficiency. Equation 4.2 puts
/// the same efficiency into c_d, so it cancels: P = power_w (|v| / speed_m_s)^3. It is declared
/// nevertheless, because a user with another drag gives it as mechanical power.
///
/// The author's program draws a flat power while the vehicle turns in place, which eq. 4.3 omits.
///
/// By `thrust` the power follows from the force: a thrust T at rest, under way or backwards draws
/// |T| v(T) / efficiency, with v(T) the steady speed through water that |T| would keep up. For a
/// propeller, whose thrust goes with the square of its revolutions and its power with their cube,
/// that is the power at these revolutions. It is exact at a steady speed. It leaves out that a
/// propeller takes more torque when held still and less when it races (some tens of percent).
struct Energy {
  enum class Law { vehicle, cubic, constant, thrust };
  enum class Battery { ignored, limits };

  /// Rypkema 2015, Table 4.1.
  struct Efficiency {
    double propeller = 0.58, shaft = 0.7, gear = 0.9, motor = 0.8;

    static void declare(Options<Efficiency>& o);
    double total() const { return propeller * shaft * gear * motor; }
  };

  double power_w = 90.0;
  double power_speed_m_s = 1.0;
  Law law = Law::vehicle;
  Efficiency efficiency;
  double turning_power_w = 96.0;
  double turning_threshold = 0.2;
  double hotel_w = 1.5;
  double ping_j = 2.4;
  double battery_wh = 520.0;
  Battery battery = Battery::ignored;

  static void declare(Options<Energy>& o);
};

/// The electrical power that thrust and turning draw.
class PropulsionPower {
 public:
  /// Of a vehicle whose own law is `own`.
  PropulsionPower(const Energy& energy, Energy::Law own)
      : energy_(energy),
        law_(energy.law == Energy::Law::vehicle ? own : energy.law),
        per_speed_(1.0 / energy.power_speed_m_s),
        per_efficiency_(1.0 / energy.efficiency.total()) {}

  /// Watts at a speed through water (m/s), for a thrust ahead (N) that would keep up
  /// `sustained_m_s`, with heading thrust in [-1, 1].
  double operator()(double speed_m_s, double thrust_n, double sustained_m_s,
                    double heading_thrust) const {
    if (std::abs(heading_thrust) > energy_.turning_threshold) return energy_.turning_power_w;
    if (law_ == Energy::Law::thrust) {
      return std::abs(thrust_n * sustained_m_s) * per_efficiency_;
    }
    const double ratio = std::abs(speed_m_s) * per_speed_;
    if (law_ == Energy::Law::cubic) return energy_.power_w * ratio * ratio * ratio;
    return ratio > 0.0 ? energy_.power_w : 0.0;
  }

 private:
  Energy energy_;
  Energy::Law law_;
  double per_speed_, per_efficiency_;
};

inline constexpr double joules_per_wh = 3600.0;

}  // namespace shoal::scenarios
