#include "shoal/scenarios/estimators/kinematic_model.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/scenarios/sluggish_vehicle.hpp"

namespace shoal::scenarios {
namespace {

VehicleState state(std::initializer_list<double> values) {
  VehicleState x;
  int i = 0;
  for (const double value : values) x(i++) = value;
  return x;
}

TEST(KinematicModel, StartsDownWhenTheNoseIsUnderTheHorizon) {
  // z is down and theta is positive nose up.
  const VehicleState x = KinematicModel{2.0}(state({1, 0, 0, 0, 0, 0, 0, 0, 10, 0, -0.3, 0}));
  EXPECT_NEAR(x(6), 2.0 * std::cos(0.3), 1e-15);
  EXPECT_EQ(x(7), 0.0);
  EXPECT_NEAR(x(8), 10.0 + 2.0 * std::sin(0.3), 1e-15);
}

TEST(KinematicModel, GoesToStarboardAlongItsStarboardAxis) {
  // Heading east (psi = 90 deg from north), starboard is south.
  const VehicleState x =
      KinematicModel{1.0}(state({0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, std::numbers::pi / 2}));
  EXPECT_NEAR(x(6), -1.0, 1e-15);
  EXPECT_NEAR(x(7), 0.0, 1e-15);
}

TEST(KinematicModel, StaysOnACircle) {
  const double u = 1.5, r = 0.05;
  VehicleState x = state({u, 0, 0, 0, 0, r, 0, -u / r, 0, 0, 0, 0});
  for (int k = 0; k < 200; ++k) {
    x = KinematicModel{0.5}(x);
    EXPECT_NEAR(x.segment<2>(6).norm(), u / r, 0.01);
  }
  EXPECT_NEAR(x(11), 200 * 0.5 * r, 1e-12);
}

TEST(KinematicModel, ErrsWithTheCubeOfItsPeriodWhileItTumbles) {
  const VehicleState x = state({1.2, 0.1, -0.2, 0.2, -0.1, 0.3, 5, 6, 7, 0.4, -0.3, 2});
  const auto error = [&](double period_s) {
    constexpr int parts = 1000;
    VehicleState exact = x;
    for (int k = 0; k < parts; ++k) exact = KinematicModel{period_s / parts}(exact);
    return (KinematicModel{period_s}(x)-exact).norm();
  };
  EXPECT_LT(error(0.5), 2e-3);
  EXPECT_NEAR(error(0.4) / error(0.2), 8.0, 1.0);
}

TEST(KinematicModel, TurnsWithTheBodyRatesAsRotationMatricesDo) {
  const Eigen::Vector3d angles(0.4, -0.3, 2.0), rates(0.2, -0.1, 0.3);
  const auto attitude = [](const Eigen::Vector3d& a) {
    return Eigen::Matrix3d(Eigen::AngleAxisd(a(2), Eigen::Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(a(1), Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(a(0), Eigen::Vector3d::UnitX()));
  };
  VehicleState x = VehicleState::Zero();
  x.segment<3>(3) = rates;
  x.tail<3>() = angles;
  x.head<3>() = Eigen::Vector3d(1.0, 2.0, 3.0);
  constexpr double dt = 1e-4;
  const VehicleState moved = KinematicModel{dt}(x);
  const Eigen::Matrix3d turned =
      attitude(angles) *
      Eigen::AngleAxisd(rates.norm() * dt, rates.normalized()).toRotationMatrix();
  EXPECT_LT((attitude(moved.tail<3>()) - turned).norm(), 1e-11);
  const Eigen::Vector3d velocity = attitude(angles) * x.head<3>();
  EXPECT_LT((moved.segment<3>(6) / dt - velocity).norm(), 1e-3);
}

TEST(Linearised, GoesWhereTheCostlyModelGoesAtTheCentreAndBesideIt) {
  const tests::SluggishVehicle model{0.5, 1.5, 0.1};
  const VehicleState centre = state({1, 0.1, 0, 0, 0.02, 0.05, 3, 4, 5, 0.1, 0.05, 3.13});
  VehicleState carried = model(centre);
  carried(11) = wrapped(carried(11));  // it comes round
  const Eigen::Vector2d water(0.3, -0.2);
  const auto belief = [&](const VehicleState& x) {
    return (VehicleBelief() << x, water).finished();
  };
  carried.segment<2>(6) += 0.5 * water;
  const Linearised linearised(KinematicModel{0.5}, belief(centre), carried, model.tangent(centre));
  const auto off = [&](const VehicleState& x) {
    const VehicleBelief there = linearised(belief(x));
    EXPECT_EQ(there.tail<2>(), water);
    return (there.head<12>() - model(x, water)).norm();
  };
  EXPECT_LT(off(centre), 1e-14);
  VehicleState beside = centre;
  beside.head<6>() << 1.05, 0.05, 0.05, 0.02, -0.02, 0.1;
  beside(9) += 0.05;
  beside(10) -= 0.05;
  beside(11) -= 0.1;
  EXPECT_LT(off(beside), 0.005);
  EXPECT_GT((KinematicModel{0.5}(beside, water) - model(beside, water)).norm(), 0.02);
}

TEST(KinematicModel, IsCarriedByTheWater) {
  const VehicleState x = state({1, 0.1, 0, 0, 0.02, 0.05, 3, 4, 5, 0.1, 0.05, 3.13});
  const Eigen::Vector2d water(0.3, -0.2);
  VehicleState carried = KinematicModel{0.5}(x);
  carried.segment<2>(6) += 0.5 * water;
  EXPECT_LT((KinematicModel{0.5}(x, water) - carried).norm(), 1e-15);
  const VehicleBelief believed = (VehicleBelief() << x, water).finished();
  const VehicleBelief expected = (VehicleBelief() << carried, water).finished();
  EXPECT_LT((KinematicModel{0.5}(believed)-expected).norm(), 1e-15);
}

TEST(KinematicModel, TurnsALevelVelocityIntoTheBodyAndBack) {
  const Eigen::Vector3d angles(0.3, -0.4, 2.0);
  const Eigen::Vector2d level(0.3, -0.2);
  const Eigen::Vector3d back =
      KinematicModel::velocity(angles, KinematicModel::in_body(angles, level));
  EXPECT_LT((back - Eigen::Vector3d(0.3, -0.2, 0.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace shoal::scenarios
