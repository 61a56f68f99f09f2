#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "shoal/core/angles.hpp"
#include "shoal/scenarios/estimators/vehicle_state.hpp"

namespace shoal::scenarios {

/// Carries a vehicle on as it moves: velocities in body axes stay, the attitude turns with p, q, r,
/// the position follows. One midpoint step; it knows no forces.
///
/// A callable VehicleBelief -> VehicleBelief for a filter that cannot afford the forces at every
/// sigma point, and of a state in known water. Not finite where the nose points straight up or
/// down.
struct KinematicModel {
  double period_s;

  VehicleState operator()(const VehicleState& x,
                          const Eigen::Vector2d& water = Eigen::Vector2d::Zero()) const {
    VehicleState moved = x;
    const Eigen::Vector3d middle = x.tail<3>() + 0.5 * period_s * euler_rates(x.tail<3>(), x);
    moved.tail<3>() += period_s * euler_rates(middle, x);
    moved.segment<3>(6) += period_s * velocity(middle, x.head<3>());
    moved.segment<2>(6) += period_s * water;
    return moved;
  }

  VehicleBelief operator()(const VehicleBelief& x) const {
    VehicleBelief moved;
    moved << (*this)(VehicleState(x.head<12>()), x.tail<2>()), x.tail<2>();
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

  /// In body axes, of a velocity north and east: the first two columns of the transpose.
  static Eigen::Vector3d in_body(const Eigen::Vector3d& angles, const Eigen::Vector2d& level) {
    const double cf = std::cos(angles(0)), sf = std::sin(angles(0));
    const double ct = std::cos(angles(1)), st = std::sin(angles(1));
    const double cp = std::cos(angles(2)), sp = std::sin(angles(2));
    const double x = cp * level(0) + sp * level(1), y = cp * level(1) - sp * level(0);
    return {ct * x, cf * y + sf * st * x, cf * st * x - sf * y};
  }
};

/// How the accelerations of a body (rows, of u v w p q r) change with its velocities, its roll and
/// its pitch (columns).
using BodyTangent = Eigen::Matrix<double, 6, 8>;

/// A costly model at the centre, its linear terms and exact kinematics for the spread about it: one
/// call of the costly model in a cycle instead of 29.
class Linearised {
 public:
  /// `centre` is a belief, `carried` where the costly model takes its state, `tangent` the model's
  /// there.
  Linearised(const KinematicModel& kinematic, const VehicleBelief& centre,
             const VehicleState& carried, const BodyTangent& tangent)
      : kinematic_(kinematic), centre_(centre), carried_(carried) {
    // exp(A T) to the fourth order, as RK4 would take it; roll and pitch follow p and q.
    using Square = Eigen::Matrix<double, 8, 8>;
    Square A = Square::Zero();
    A.topRows<6>() = tangent;
    A(6, 3) = A(7, 4) = 1.0;
    A *= kinematic.period_s;
    Square series = Square::Identity();
    for (const double k : {4.0, 3.0, 2.0, 1.0}) {
      const Square next = A * series / k;
      series = Square::Identity() + next;
    }
    growth_ = series.topRows<6>();
    shift_ = carried - moved(centre);
    for (int i = 9; i < 12; ++i) shift_(i) = wrapped(shift_(i));  // it may have come round
  }

  VehicleBelief operator()(const VehicleBelief& x) const {
    VehicleBelief there;
    there << moved(x) + shift_, x.tail<2>();
    return there;
  }

 private:
  VehicleState moved(const VehicleBelief& x) const {
    Eigen::Matrix<double, 8, 1> off;
    off << x.head<6>() - centre_.head<6>(), wrapped(x(9) - centre_(9)), x(10) - centre_(10);
    VehicleState on_the_way = x.head<12>();
    const Eigen::Matrix<double, 6, 1> then = carried_.head<6>() + growth_ * off;
    on_the_way.head<6>() = 0.5 * (on_the_way.head<6>() + then);
    VehicleState there = kinematic_(on_the_way, x.tail<2>());
    there.head<6>() = then;
    return there;
  }

  KinematicModel kinematic_;
  VehicleBelief centre_;
  VehicleState carried_, shift_ = VehicleState::Zero();
  Eigen::Matrix<double, 6, 8> growth_;
};

}  // namespace shoal::scenarios
