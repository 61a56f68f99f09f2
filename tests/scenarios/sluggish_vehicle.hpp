#pragma once

#include "shoal/scenarios/estimators/kinematic_model.hpp"
#include "shoal/scenarios/estimators/process_noise.hpp"

namespace shoal::tests {

/// A vehicle in six degrees of freedom that lags behind its commanded surge and turn, rights
/// itself, and has no other forces. A callable state -> state over a period.
struct SluggishVehicle {
  double period_s;
  double surge_m_s, turn_rad_s;
  scenarios::BodyAcceleration disturbance = scenarios::BodyAcceleration::Zero();

  scenarios::VehicleState operator()(const scenarios::VehicleState& start,
                                     const Eigen::Vector2d& water = Eigen::Vector2d::Zero()) const {
    constexpr int steps = 5;
    const double dt = period_s / steps;
    const scenarios::KinematicModel moves{dt};
    scenarios::VehicleState x = start;
    for (int step = 0; step < steps; ++step) {
      scenarios::BodyAcceleration a = disturbance;
      a(0) += (surge_m_s - x(0)) / 10.0;
      a(1) -= x(1) / 3.0;
      a(2) -= x(2) / 3.0;
      a(3) -= x(3) / 2.0 + 0.3 * std::sin(x(9));
      a(4) -= x(4) / 2.0 + 0.2 * std::sin(x(10));
      a(5) += (turn_rad_s - x(5)) / 3.0;
      x = moves(x, water);
      x.head<6>() += dt * a;
    }
    return x;
  }

  scenarios::BodyTangent tangent(const scenarios::VehicleState& x) const {
    scenarios::BodyTangent lags = scenarios::BodyTangent::Zero();
    lags.diagonal() << -1.0 / 10.0, -1.0 / 3.0, -1.0 / 3.0, -1.0 / 2.0, -1.0 / 2.0, -1.0 / 3.0;
    lags(3, 6) = -0.3 * std::cos(x(9));
    lags(4, 7) = -0.2 * std::cos(x(10));
    return lags;
  }
};

}  // namespace shoal::tests
