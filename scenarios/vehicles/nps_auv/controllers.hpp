#pragma once

#include "shoal/core/options.hpp"
#include "shoal/scenarios/vehicles/nps_auv/hydrodynamics.hpp"

namespace shoal::scenarios {

/// What the controllers are to bring about. Angles to starboard, rad; depth in m.
struct NpsAuvTask {
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
  double heading_rad = 0.0;
  double turn_rate_rad_s = 0.0;
  double depth_m = 0.0;
};

/// The three sliding mode controllers of Barisic et al. 2011, eq. 41-45, with C36 to C39. Errors
/// are state minus task.
struct NpsAuvControllers {
  double speed_gain_m_s2 = 0.05;  ///< eta_u
  double speed_layer_m_s = 0.1;   ///< phi_u
  double propeller_max_rad_s = 90.0;
  bool reverse = false;
  double plane_max_rad = 0.4;

  static void declare(Options<NpsAuvControllers>& o);

  /// The inputs for a believed state. Bow planes stay amidships.
  NpsAuvInputs operator()(const VehicleState& believed, const NpsAuvTask& task) const;
  /// The same for a vehicle that drifts: no propeller, the rudder amidships.
  NpsAuvInputs drifting(const VehicleState& believed, double depth_m) const;

 private:
  double propeller(double u, const NpsAuvTask& task) const;
  double stern_planes(const VehicleState& believed, double depth_m) const;
};

}  // namespace shoal::scenarios
