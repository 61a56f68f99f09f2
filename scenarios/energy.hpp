#pragma once

#include <cmath>

#include "shoal/core/options.hpp"

namespace shoal::scenarios {

/// What the vehicle's consumers draw: Rypkema 2015, sec. 4.1.1, eq. 4.1-4.4, Table 4.1.
///
/// The shaft power is c_d |v|^3, the electrical power that over the efficiency. Equation 4.2 puts
/// the same efficiency into c_d, so it cancels: P = power_w (|v| / speed_m_s)^3. It is declared
/// nevertheless, because a user who gives another drag gives it as mechanical power.
///
/// The author's program draws a flat power while the vehicle turns in place, which eq. 4.3 omits.
struct Energy {
  enum class Law { cubic, constant };

  double power_w = 90.0;
  double power_speed_m_s = 1.0;
  Law law = Law::cubic;
  double turning_power_w = 96.0;
  double turning_threshold = 0.2;
  double hotel_w = 1.5;
  double ping_j = 2.4;
  double battery_wh = 520.0;

  static void declare(Options<Energy>& o);
};

/// The electrical power that thrust and turning draw.
class PropulsionPower {
 public:
  explicit PropulsionPower(const Energy& energy)
      : energy_(energy), per_speed_(1.0 / energy.power_speed_m_s) {}

  /// Watts at a speed through water (m/s), with heading thrust in [-1, 1].
  double operator()(double speed_m_s, double heading_thrust) const {
    if (std::abs(heading_thrust) > energy_.turning_threshold) return energy_.turning_power_w;
    const double ratio = std::abs(speed_m_s) * per_speed_;
    if (energy_.law == Energy::Law::cubic) return energy_.power_w * ratio * ratio * ratio;
    return ratio > 0.0 ? energy_.power_w : 0.0;
  }

 private:
  Energy energy_;
  double per_speed_;
};

inline constexpr double joules_per_wh = 3600.0;

}  // namespace shoal::scenarios
