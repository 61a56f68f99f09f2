#pragma once

#include "shoal/scenarios/estimators/vehicle_state.hpp"

namespace shoal::bench {

/// Straight ahead at about its usual speed, with a little of every other motion.
inline scenarios::VehicleState cruising() {
  scenarios::VehicleState x = scenarios::VehicleState::Zero();
  x.head<6>() << 1.4, 0.05, -0.02, 0.01, -0.01, 0.05;
  return x;
}

}  // namespace shoal::bench
