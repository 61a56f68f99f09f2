#pragma once

#include <Eigen/Core>
#include <array>

namespace shoal::scenarios {

/// The state of a vehicle in six degrees of freedom: [u v w | p q r | x y z | phi theta psi] in
/// m/s, rad/s, m, rad. Body axes are forward, starboard, down; x, y, z are north, east, down, and
/// psi turns to starboard (Barisic et al. 2011, sec. 5.2). [u v w] is relative to the water.
using VehicleState = Eigen::Matrix<double, 12, 1>;
using VehicleCovariance = Eigen::Matrix<double, 12, 12>;

/// What a vehicle believes: its state and the velocity of the water, north and east, in m/s.
using VehicleBelief = Eigen::Matrix<double, 14, 1>;
using BeliefCovariance = Eigen::Matrix<double, 14, 14>;

/// Which of the twelve are angles that come round.
constexpr std::array<bool, 12> vehicle_angles{false, false, false, false, false, false,
                                              false, false, false, true,  true,  true};
constexpr std::array<bool, 14> belief_angles{false, false, false, false, false, false, false,
                                             false, false, true,  true,  true,  false, false};

}  // namespace shoal::scenarios
