#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "shoal/core/options.hpp"
#include "shoal/formations/guidance.hpp"
#include "shoal/formations/neighbourhood.hpp"

namespace shoal::formations {

/// What a vehicle is to be asked for at most: Barisic et al. 2011, sec. 5.4.
struct PerformanceEnvelope {
  double speed_max_m_s = 2.0;
  double speed_min_m_s = 0.0;
  double acceleration_max_m_s2 = 0.05;
  double turn_rate_max_rad_s = 0.08;
  double turn_acceleration_max_rad_s2 = 0.04;

  static void declare(Options<PerformanceEnvelope>& o);
  std::optional<std::string> complaint() const;
};

/// How a vehicle moves when it is commanded: the estimated forward speed (m/s) and turn rate
/// (rad/s), not what was commanded before.
struct Motion {
  double speed_m_s = 0.0;
  double turn_rate_rad_s = 0.0;
};

/// The velocities after one period, over the period, that the envelope allows: an annular sector
/// about the heading, eq. 85-88, not symmetric to it while the vehicle turns (C59).
///
/// A motion that no command can bring back into the envelope within one period leaves no such
/// velocity. Then the bars on speed and turn rate hold, those on their changes do not, and
/// `reachable` is false.
struct AdmissibleSet {
  double size_min_m_s2 = 0.0;  ///< R_min
  double size_max_m_s2 = 0.0;  ///< R_max
  double turn_min_rad = 0.0;
  double turn_max_rad = 0.0;
  bool reachable = true;

  AdmissibleSet(const PerformanceEnvelope& envelope, const Motion& motion, double period_s);
};

/// A force per unit of mass that was made admissible, and the commands that follow from it.
///
/// Forces are (along the heading, across it), m/s2; across is the side that positive turns lead to.
struct ConditionedCommand {
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double turn_rad = 0.0;  ///< of the heading, within the period
  double turn_rate_rad_s = 0.0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  bool reachable = true;  ///< see AdmissibleSet
};

/// Clamps a force to what the envelope allows: Table 3 as corrected (C56-C62). Accelerating, the
/// turn comes first; braking, the loss of speed.
///
/// Numbers must be finite, the period above zero. A force that is admissible comes out unchanged
/// but for rounding.
ConditionedCommand conditioned(const Eigen::Vector2d& force, const Motion& motion, double period_s,
                               const PerformanceEnvelope& envelope);

/// The command that follows from a force (m/s2, axes of the own positions) on a vehicle.
Command commanded(const Eigen::Vector2d& force, const OwnState& own, double period_s,
                  const PerformanceEnvelope& envelope);

}  // namespace shoal::formations
