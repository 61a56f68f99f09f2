#pragma once

#include <Eigen/Core>
#include <array>

namespace shoal::scenarios {

/// The state of a vehicle in six degrees of freedom: [u v w | p q r | x y z | phi theta psi] in
/// m/s, rad/s, m, rad. Body axes are forward, starboard, down; x, y, z are north, east, down, and
/// psi turns to starboard (Barisic et al. 2011, sec. 5.2). Whoever holds such a state converts it.
using VehicleState = Eigen::Matrix<double, 12, 1>;
using VehicleCovariance = Eigen::Matrix<double, 12, 12>;

/// Which of the twelve are angles that come round.
constexpr std::array<bool, 12> vehicle_angles{false, false, false, false, false, false,
                                              false, false, false, true,  true,  true};

}  // namespace shoal::scenarios
