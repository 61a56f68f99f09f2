#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "shoal/core/angles.hpp"
#include "shoal/scenarios/estimators/vehicle_state.hpp"

namespace shoal::scenarios {

/// Carries a vehicle on as it moves: velocities in body axes stay, the attitude turns with p, q, r,
/// the position follows. One midpoint step; it knows no forces.
///
/// A callable VehicleState -> VehicleState for a filter that cannot afford the forces at every
/// sigma point. Not finite where the nose points straight up or down.
struct KinematicModel {
  double period_s;

  VehicleState operator()(const VehicleState& x) const {
    VehicleState moved = x;
    const Eigen::Vector3d middle = x.tail<3>() + 0.5 * period_s * euler_rates(x.tail<3>(), x);
    moved.tail<3>() += period_s * euler_rates(middle, x);
    moved.segment<3>(6) += period_s * velocity(middle, x.head<3>());
    return moved;
  }

  /// The rates of (phi, theta, psi) at these angles, rad/s.
  static Eigen::Vector3d euler_rates(const Eigen::Vector3d& angles, const VehicleState& x) {
    const double p = x(3), q = x(4), r = x(5);
    const double cosine = std::cos(angles(0)), sine = std::sin(angles(0));
    const double turning = sine * q + cosine * r;
    const double c = std::cos(angles(1));
    return {p + turning * std::sin(angles(1)) / c, cosine * q - sine * r, turning / c};
  }

  /// Over ground (north, east, down), of a velocity in body axes: R_z(psi) R_y(theta) R_x(phi).
  static Eigen::Vector3d velocity(const Eigen::Vector3d& angles, const Eigen::Vector3d& body) {
    const double cf = std::cos(angles(0)), sf = std::sin(angles(0));
    const double ct = std::cos(angles(1)), st = std::sin(angles(1));
    const double cp = std::cos(angles(2)), sp = std::sin(angles(2));
    const double y = cf * body(1) - sf * body(2);
    const double z = sf * body(1) + cf * body(2);
    const double x = ct * body(0) + st * z;
    return {cp * x - sp * y, sp * x + cp * y, ct * z - st * body(0)};
  }
};

/// A costly model at the centre, the kinematic one for the spread about it: every sigma point goes
/// where kinematics take it, moved by what forces and inputs change at the centre. One call of the
/// costly model in a cycle instead of 25.
///
///     filter.predict(Recentred(kinematic, filter.state(), six_dof(filter.state())));
class Recentred {
 public:
  /// `centre` is a state and `carried` where the costly model takes it.
  Recentred(const KinematicModel& kinematic, const VehicleState& centre,
            const VehicleState& carried)
      : kinematic_(kinematic), shift_(carried - kinematic(centre)) {
    for (int i = 9; i < 12; ++i) shift_(i) = wrapped(shift_(i));  // it may have come round
  }

  VehicleState operator()(const VehicleState& x) const { return kinematic_(x) + shift_; }

 private:
  KinematicModel kinematic_;
  VehicleState shift_;
};

}  // namespace shoal::scenarios
