// The printed numbers of the sensors' noise: Barisic et al. 2011, eqs. 65-75.

#include <numbers>

#include "shoal/scenarios/estimators/sensor_noise.hpp"

namespace shoal::scenarios {
namespace {

constexpr double pi = std::numbers::pi;

// clang-format off
GaussMarkov::Matrix velocity_transition() {  // eq. 66
  return GaussMarkov::Matrix{
      {0.7542, 0.1000, 0.1000, 0.0208, 0.0208, 0.0042},
      {0.4739, 0.3365, 0.1043, 0.0379, 0.0284, 0.0190},
      {0.4739, 0.1043, 0.3365, 0.0284, 0.0379, 0.0190},
      {0.3825, 0.1749, 0.1749, 0.0984, 0.0984, 0.0710},
      {0.3825, 0.1749, 0.1749, 0.0984, 0.0984, 0.0710},
      {0.0270, 0.1622, 0.1622, 0.2703, 0.2703, 0.1081}};
}
GaussMarkov::Matrix rate_transition() {  // eq. 68
  return GaussMarkov::Matrix{
      {0.5928, 0.1596, 0.1596, 0.0423, 0.0423, 0.0033},
      {0.4978, 0.2489, 0.1511, 0.0356, 0.0533, 0.0133},
      {0.4978, 0.1511, 0.2489, 0.0533, 0.0356, 0.0133},
      {0.5234, 0.1963, 0.0561, 0.0935, 0.0748, 0.0561},
      {0.5234, 0.0561, 0.1963, 0.0748, 0.0935, 0.0561},
      {0.0588, 0.2941, 0.2941, 0.1176, 0.1176, 0.1176}};
}
GaussMarkov::Matrix position_transition() {  // eq. 70
  return GaussMarkov::Matrix{
      {0.4809, 0.1967, 0.1967, 0.0601, 0.0601, 0.0055},
      {0.4160, 0.3200, 0.1440, 0.0800, 0.0320, 0.0080},
      {0.4160, 0.1440, 0.3200, 0.0320, 0.0800, 0.0080},
      {0.3689, 0.2136, 0.1359, 0.1942, 0.0777, 0.0097},
      {0.3689, 0.1359, 0.2136, 0.0777, 0.1942, 0.0097},
      {0.0102, 0.2959, 0.2959, 0.1837, 0.1837, 0.0306}};
}
GaussMarkov::Matrix depth_transition() {  // eq. 72
  return GaussMarkov::Matrix{
      {0.5198, 0.1762, 0.1762, 0.0617, 0.0617, 0.0044},
      {0.4020, 0.4020, 0.1106, 0.0503, 0.0302, 0.0050},
      {0.4020, 0.1106, 0.4020, 0.0302, 0.0503, 0.0050},
      {0.3704, 0.2667, 0.1481, 0.1481, 0.0593, 0.0074},
      {0.3704, 0.1481, 0.2667, 0.0593, 0.1481, 0.0074},
      {0.0667, 0.2000, 0.2000, 0.2000, 0.2000, 0.1333}};
}
GaussMarkov::Matrix attitude_transition() {  // eq. 74
  return GaussMarkov::Matrix{
      {0.4686, 0.2301, 0.2301, 0.0335, 0.0335, 0.0042},
      {0.4014, 0.2721, 0.1769, 0.1020, 0.0340, 0.0136},
      {0.4014, 0.1769, 0.2721, 0.0340, 0.1020, 0.0136},
      {0.3982, 0.1403, 0.0995, 0.1719, 0.0995, 0.0905},
      {0.3982, 0.0995, 0.1403, 0.0995, 0.1719, 0.0905},
      {0.0526, 0.1579, 0.1579, 0.2105, 0.2105, 0.2105}};
}
// clang-format on

VehicleCovariance mixing() {
  VehicleCovariance S = VehicleCovariance::Zero();
  const auto leak = [&S](int row, int column, int rows, int columns, double share) {
    S.block(row, column, rows, columns).setConstant(share);
    S.block(column, row, columns, rows).setConstant(share);
  };
  leak(0, 0, 3, 3, 1e-4);  // u, v, w
  leak(0, 3, 3, 3, 3e-5);  // and p, q, r
  leak(0, 9, 3, 3, 5e-7);  // and the angles
  leak(3, 3, 3, 3, 6e-4);  // p, q, r
  leak(6, 6, 2, 2, 3e-4);  // x, y
  leak(6, 8, 2, 1, 4e-6);  // and z
  leak(6, 9, 2, 3, 2e-5);  // and the angles
  leak(9, 9, 3, 3, 3e-5);  // phi, theta, psi
  S.diagonal().setOnes();
  return S;
}

}  // namespace

const GaussMarkov& sensor_model(Sensor sensor) {
  static const GaussMarkov velocity(  // eq. 65, m/s
      {0, 0.06, 0.03815}, {0.09, 0.11, 0.05}, {0.2981, 0.24, 0.09}, velocity_transition());
  static const GaussMarkov rate(  // eq. 67, rad/s
      {0, pi / 85, pi / 227.608}, {pi / 72, pi / 60, pi / 144.201},
      {pi / 21.5, pi / 18.8, pi / 64.454}, rate_transition());
  static const GaussMarkov position(  // eq. 69, m
      {0, 1.0, 0.012}, {1.3, 1.5, 0.06}, {3.85, 4.0, 1.28}, position_transition());
  static const GaussMarkov depth(  // eq. 71, m
      {0, 0.08, 0.012}, {0.11, 0.1208, 0.06}, {0.55, 0.71, 1.28}, depth_transition());
  static const GaussMarkov attitude(  // eq. 73, rad
      {0, pi / 220, pi / 98.05}, {pi / 192, pi / 176, pi / 42.6}, {pi / 60, pi / 42, pi / 10},
      attitude_transition());
  switch (sensor) {
    case Sensor::velocity:
      return velocity;
    case Sensor::rate:
      return rate;
    case Sensor::position:
      return position;
    case Sensor::depth:
      return depth;
    case Sensor::attitude:
      break;
  }
  return attitude;
}

const VehicleCovariance& sensor_mixing() {
  static const VehicleCovariance S = mixing();
  return S;
}

}  // namespace shoal::scenarios
