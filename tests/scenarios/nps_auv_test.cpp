#include <gtest/gtest.h>

#include <cmath>

#include "shoal/core/angles.hpp"
#include "shoal/scenarios/energy.hpp"
#include "shoal/scenarios/vehicles/nps_auv/controllers.hpp"
#include "tests/support/reference_table.hpp"

namespace shoal::scenarios {
namespace {

using tests::ReferenceTable;

const std::vector<std::string> state_columns{"u", "v", "w", "p",   "q",     "r",
                                             "x", "y", "z", "phi", "theta", "psi"};
const std::vector<std::string> input_columns{"delta_r", "delta_s", "delta_bp", "delta_bs",
                                             "n_rad_s"};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

VehicleState state_of(const ReferenceTable& table, std::size_t row) {
  VehicleState x;
  for (int i = 0; i < 12; ++i) x(i) = table.number(row, state_columns[static_cast<std::size_t>(i)]);
  return x;
}

NpsAuvInputs inputs_of(const ReferenceTable& table, std::size_t row) {
  const auto number = [&](const char* name) { return table.number(row, name); };
  return {number("delta_r"), number("delta_s"), number("delta_bp"), number("delta_bs"),
          number("n_rad_s")};
}

TEST(NpsAuvModel, HasTheMassMatrixOfTheReference) {
  NpsAuvModel::Matrix6 expected;                             // nps_auv_mass_matrix.csv
  expected << 6020.2726, 0, 0, 0, 332.72694, 0,              //
      0, 9548.6575, 0, -380.069826, 0, -473.42886,           //
      0, 0, 23319.78, 0, 2682.76354, 0,                      //
      0, -380.069826, 0, 4128.977465, 13.58, 84.67323381,    //
      332.72694, 0, 2682.76354, 13.58, 49133.616905, 13.58,  //
      0, -473.42886, 0, 84.67323381, 13.58, 20696.323381;
  EXPECT_LT((NpsAuvModel().mass_matrix() - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(NpsAuvModel, HasTheDerivativesOfTheReference) {
  const std::vector<std::string> forces{"F_X", "F_Y", "F_Z", "F_K", "F_M", "F_N"};
  std::vector<std::string> rates;
  for (const std::string& name : state_columns) rates.push_back("d" + name);
  const ReferenceTable table(
      "nps_auv_derivatives.csv",
      joined(joined(joined(state_columns, input_columns), joined(rates, forces)), {"epsilon"}));
  ASSERT_GT(table.rows(), 100u);
  const NpsAuvModel model;
  const auto close = [](double got, double expected) {
    return std::abs(got - expected) <= 1e-10 * std::abs(expected) + 1e-300;
  };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const VehicleState x = state_of(table, row);
    const NpsAuvInputs in = inputs_of(table, row);
    const VehicleState rate = model.derivative(x, in);
    const auto force = model.forces(x, in);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_PRED2(close, rate(static_cast<int>(i)), table.number(row, rates[i]))
          << table.line(row) << rates[i];
    }
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_PRED2(close, force(static_cast<int>(i)), table.number(row, forces[i]))
          << table.line(row) << forces[i];
    }
    EXPECT_PRED2(close, model.epsilon(x(0), in.propeller_rad_s), table.number(row, "epsilon"));
  }
}

TEST(NpsAuvModel, FollowsTheTrajectoriesOfTheReference) {
  const ReferenceTable table("nps_auv_trajectories.csv",
                             joined(joined(state_columns, input_columns), {"run", "t"}));
  const NpsAuvModel model;
  constexpr double step_s = 0.05;
  VehicleState x;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.number(row, "t");
    if (t == 0.0) {
      x = state_of(table, row);
      continue;
    }
    const NpsAuvInputs before = inputs_of(table, row - 1);
    const int steps = static_cast<int>(std::lround((t - table.number(row - 1, "t")) / step_s));
    for (int k = 0; k < steps; ++k) x = model.integrate(x, before, step_s);
    const VehicleState expected = state_of(table, row);
    ASSERT_LT((x - expected).cwiseAbs().maxCoeff(), 1e-6) << table.line(row);
  }
}

TEST(NpsAuvModel, CruisesAtTheDesignPoint) {
  const NpsAuvModel model;
  VehicleState x = VehicleState::Zero();
  x(0) = 1.5;
  for (int k = 0; k < 40000; ++k) x = model.integrate(x, {.propeller_rad_s = 52.359}, 0.05);
  EXPECT_NEAR(x(0), 1.832, 2e-3);  // C28; the asymmetric inertia makes it swerve a little
}

TEST(NpsAuvModel, IsAlmostTheSameInAMirror) {
  // The products of inertia, 0.1 % of the moments, are all that tells port from starboard.
  VehicleState x = VehicleState::Zero(), mirrored = x;
  x(0) = mirrored(0) = 1.5;
  const NpsAuvModel model;
  const NpsAuvInputs port{.rudder_rad = 0.1, .propeller_rad_s = 52.0};
  const NpsAuvInputs starboard{.rudder_rad = -0.1, .propeller_rad_s = 52.0};
  for (int k = 0; k < 400; ++k) {
    x = model.integrate(x, port, 0.05);
    mirrored = model.integrate(mirrored, starboard, 0.05);
  }
  VehicleState flipped = mirrored;
  for (const int i : {1, 3, 5, 7, 9, 11}) flipped(i) = -flipped(i);
  EXPECT_LT(x(11), -0.3) << "a rudder above zero turns to port";
  EXPECT_LT((x - flipped).cwiseAbs().maxCoeff(), 0.02);
}

TEST(NpsAuvModel, LosesItsMotionToTheWater) {
  const NpsAuvModel model;
  VehicleState x = VehicleState::Zero();
  x.head<6>() << 0.8, 0.4, -0.3, 0.05, 0.1, -0.1;
  const auto energy = [&] { return 0.5 * x.head<6>().dot(model.mass_matrix() * x.head<6>()); };
  const double before = energy();
  for (int k = 0; k < 6000; ++k) x = model.integrate(x, {}, 0.05);
  EXPECT_LT(energy(), 0.05 * before);
  EXPECT_TRUE(x.allFinite());
}

TEST(NpsAuvModel, IsCarriedByAUniformCurrentAndFeelsNothingOfIt) {
  const NpsAuvModel model;
  const NpsAuvInputs in{.rudder_rad = 0.05, .propeller_rad_s = 45.0};
  const Eigen::Vector2d water(0.3, -0.2);
  VehicleState still = VehicleState::Zero();
  still(0) = 1.0;
  VehicleState carried = still;
  for (int k = 0; k < 1000; ++k) {
    still = model.integrate(still, in, 0.05);
    carried = model.integrate(carried, in, 0.05, water);
  }
  still.segment<2>(6) += 50.0 * water;
  EXPECT_LT((still - carried).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(NpsAuvModel, TangentIsTheSlopeOfItsAccelerations) {
  const NpsAuvModel model;
  const NpsAuvInputs in{.rudder_rad = 0.05, .propeller_rad_s = 45.0};
  VehicleState x = VehicleState::Zero();
  x << 1.2, 0.1, -0.05, 0.02, -0.03, 0.05, 0, 0, 0, 0.1, -0.05, 1.0;
  const BodyTangent tangent = model.tangent(x, in);
  for (int k = 0; k < 8; ++k) {
    const int state = k < 6 ? k : k + 3;
    VehicleState up = x, down = x;
    up(state) += 1e-4;
    down(state) -= 1e-4;
    const Eigen::Matrix<double, 6, 1> slope =
        (model.derivative(up, in) - model.derivative(down, in)).head<6>() / 2e-4;
    EXPECT_LT((tangent.col(k) - slope).norm(), 1e-4 * (1.0 + slope.norm())) << k;
  }
}

TEST(NpsAuvPropulsion, DrawsTheDragTimesTheSpeedAtSteadySpeed) {
  const PropulsionPower power(Energy{}, Energy::Law::thrust);
  const double n = 1.0 / nps_auv_speed_per_revolution_m;  // 1 m/s
  const auto [thrust, speed] = nps_auv_propulsion(n);
  EXPECT_NEAR(thrust, 0.5 * 1000.0 * 5.3 * 5.3 * 0.00385, 1e-9);  // 54 N
  EXPECT_NEAR(speed, 1.0, 1e-12);
  const double drawn = power(1.0, thrust, speed, 0.0);
  EXPECT_NEAR(drawn, 54.07 / (0.58 * 0.7 * 0.9 * 0.8), 0.02);  // 185 W
  // The thrust of the equations of motion, at rest.
  const NpsAuvModel model;
  EXPECT_NEAR(model.forces(VehicleState::Zero(), {.propeller_rad_s = n})(0), thrust, 1e-9);
  // At rest and backwards the same revolutions draw the same power.
  EXPECT_EQ(power(0.0, thrust, speed, 0.0), drawn);
  const auto [pull, astern] = nps_auv_propulsion(-n);
  EXPECT_EQ(pull, -thrust);
  EXPECT_EQ(power(1.0, pull, astern, 0.0), drawn);
  const auto [twice_thrust, twice_speed] = nps_auv_propulsion(2.0 * n);
  EXPECT_NEAR(power(0.0, twice_thrust, twice_speed, 0.0), 8.0 * drawn, 1e-9);
}

TEST(NpsAuvModel, DragsAsternAsAhead) {
  const NpsAuvModel model;
  VehicleState astern = VehicleState::Zero();
  astern(0) = -1.0;
  EXPECT_GT(model.derivative(astern, {})(0), 0.0);        // the printed u^2 (...) would speed it up
  EXPECT_TRUE(std::isfinite(model.epsilon(1.0, -80.0)));  // the printed root is imaginary
  EXPECT_TRUE(model.derivative(VehicleState::Zero(), {.propeller_rad_s = 60.0}).allFinite());
}

// The controllers
// ----------------------------------------------------------------------------------

VehicleState controlled(const NpsAuvControllers& controllers, const NpsAuvTask& task, double for_s,
                        VehicleState x) {
  const NpsAuvModel model;
  const int steps = static_cast<int>(std::lround(for_s / 0.05));
  for (int k = 0; k < steps; ++k) x = model.integrate(x, controllers(x, task), 0.05);
  return x;
}

TEST(NpsAuvControllers, BringAboutWhatTheyAreAskedFor) {
  // To a speed, a heading and a depth at once: all six degrees of freedom move.
  VehicleState start = VehicleState::Zero();
  start(0) = 0.5;
  const NpsAuvTask task{.speed_m_s = 1.5, .heading_rad = radians(60.0), .depth_m = 5.0};
  const VehicleState after_40 = controlled({}, task, 40.0, start);
  const VehicleState after_140 = controlled({}, task, 100.0, after_40);
  EXPECT_NEAR(after_40(0), 1.5, 5e-3);
  EXPECT_NEAR(after_140(11), 1.047, 5e-3);
  EXPECT_NEAR(after_140(8), 4.80, 0.02);
}

TEST(NpsAuvControllers, PushTheRightWay) {
  const NpsAuvControllers controllers;
  VehicleState x = VehicleState::Zero();
  x(0) = 1.5;
  EXPECT_LT(controllers(x, {.speed_m_s = 1.5, .heading_rad = 0.2}).rudder_rad, 0.0);
  EXPECT_GT(controllers(x, {.speed_m_s = 1.5, .depth_m = 50.0}).stern_planes_rad, 0.0);
  EXPECT_GT(controllers(x, {.speed_m_s = 2.0}).propeller_rad_s,
            controllers(x, {.speed_m_s = 1.5}).propeller_rad_s);
  x(11) = 3.0;  // the short way round
  EXPECT_LT(controllers(x, {.speed_m_s = 1.5, .heading_rad = -3.0}).rudder_rad, 0.0);
}

TEST(NpsAuvControllers, DeflectAsTheirEquationsSay) {  // (43) and (44)-(45), by hand
  NpsAuvControllers controllers;
  controllers.plane_max_rad = 1.5;
  VehicleState x = VehicleState::Zero();
  x(1) = 0.1;
  x(4) = 0.02;
  x(5) = 0.05;
  x(8) = 10.5;
  x(10) = 0.1;
  x(11) = 0.07;
  const NpsAuvInputs in =
      controllers(x, {.heading_rad = 0.05, .turn_rate_rad_s = 0.01, .depth_m = 10.0});
  EXPECT_NEAR(in.rudder_rad, 0.9153813416, 1e-9);
  EXPECT_NEAR(in.stern_planes_rad, 0.6630803258, 1e-9);
}

TEST(NpsAuvControllers, BrakeWithThePropellerIfItMayTurnBackwards) {
  VehicleState fast = VehicleState::Zero();
  fast(0) = 1.5;
  const NpsAuvTask stop{};
  EXPECT_EQ(NpsAuvControllers{}(fast, stop).propeller_rad_s, 0.0);
  NpsAuvControllers braking;
  braking.reverse = true;
  EXPECT_LT(braking(fast, stop).propeller_rad_s, 0.0);
  EXPECT_LT(controlled(braking, stop, 60.0, fast)(0), 0.05);
  EXPECT_GT(controlled({}, stop, 60.0, fast)(0), 0.5) << "drag alone takes its time";
}

TEST(NpsAuvControllers, KeepDepthWhileTheVehicleDrifts) {
  const NpsAuvInputs in = NpsAuvControllers{}.drifting(VehicleState::Zero(), 0.0);
  EXPECT_EQ(in.propeller_rad_s, 0.0);
  EXPECT_EQ(in.rudder_rad, 0.0);
  EXPECT_EQ(in.stern_planes_rad, 0.0);
}

}  // namespace
}  // namespace shoal::scenarios
