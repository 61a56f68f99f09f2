#include "shoal/scenarios/vehicles/drifter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/core/angles.hpp"

namespace shoal::scenarios {
namespace {

using formations::Command;

constexpr double drifter_tick_s = 0.25;

/// One vehicle at the origin that heads east, without heading noise unless asked for.
struct OneVehicle {
  Drifter type;
  Energy energy;
  std::unique_ptr<Swarm> swarm;
  std::int64_t tick = 0;
  double u = 0.0, v = 0.0;

  explicit OneVehicle(const Drifter& drifter = quiet()) : type(drifter) {
    swarm = type.launch({Start{0.0, 0.0, 0.0}}, energy, RandomStreams(1), drifter_tick_s);
  }
  static Drifter quiet() {
    Drifter drifter;
    drifter.heading_noise_deg_s = 0.0;
    return drifter;
  }
  void run(double seconds, const Command& command) {
    const std::vector<Command> commands{command};
    for (double t = 0.0; t < seconds - 1e-9; t += drifter_tick_s) {
      swarm->advance(0, 1, tick++, commands, {&u, 1}, {&v, 1});
    }
  }
};

Command ahead(double speed_m_s, double heading_rad = 0.0) {
  return {true, heading_rad, speed_m_s};
}

TEST(Drifter, ReachesTheCommandedSpeedWithinAFewSeconds) {
  OneVehicle one;
  one.run(0.5, ahead(1.0));
  EXPECT_LT(one.swarm->speed_m_s[0], 0.6);
  one.run(5.0, ahead(1.0));
  // m / (2 * drag) = 0.6 s is the time constant at 1 m/s.
  EXPECT_NEAR(one.swarm->speed_m_s[0], 1.0, 1e-3);
}

TEST(Drifter, RoundsSpeedsAndCoursesAsTheHelmDid) {
  OneVehicle one;
  one.run(60.0, ahead(0.53, radians(30.4)));
  EXPECT_NEAR(one.swarm->speed_m_s[0], 0.6, 1e-3);
  EXPECT_NEAR(degrees(one.swarm->heading_rad[0]), 30.0, 0.01);
}

TEST(Drifter, TurnsInPlaceBeforeItThrusts) {
  OneVehicle one;
  one.run(3.0, ahead(1.0, radians(180)));
  EXPECT_EQ(one.swarm->speed_m_s[0], 0.0);
  EXPECT_EQ(one.swarm->x_m[0], 0.0);
  EXPECT_GT(std::abs(degrees(one.swarm->heading_rad[0])), 45.0);
  one.run(20.0, ahead(1.0, radians(180)));
  EXPECT_LT(one.swarm->x_m[0], -5.0);
}

TEST(Drifter, DrawsTheTurningPowerUntilTheHalfTurnIsNearlyDone) {
  // Full rate, 18 deg/s, until 2 e - 18 falls below 100 % at 59 deg: 6.7 s. Then e decays with
  // (1 + 0.18) / 0.36 = 3.3 s, until 2 e - 0.36 e / 1.18 falls below 20 % at 11.8 deg: 5.3 s.
  OneVehicle one;
  one.run(30.0, ahead(0.0, radians(180)));
  EXPECT_NEAR(std::abs(degrees(wrapped(one.swarm->heading_rad[0]))), 180.0, 0.1);
  EXPECT_NEAR(one.swarm->propulsion_j[0], 96.0 * (6.7 + 5.3), 96.0 * 0.3);
}

TEST(Drifter, DampsTheTurnByTheMeanRateOfTheHeadingErrorOverItsWindow) {
  for (const std::int64_t window : {1, 4, 9}) {
    Drifter type = OneVehicle::quiet();
    type.heading_differences = window;
    OneVehicle one(type);
    one.run(4.0, ahead(0.0, radians(40)));
    // 2 e + e' in percent of full rate, every second step of 20 Hz.
    double heading = 0.0, thrust = 0.0;
    std::vector<double> errors(static_cast<std::size_t>(window), radians(40));
    for (int k = 0; k < 80; ++k) {
      if (k % 2 == 0) {
        const double error = radians(40) - heading;
        const double before = errors[errors.size() - static_cast<std::size_t>(window)];
        errors.push_back(error);
        const double rate = (error - before) / (0.1 * static_cast<double>(window));
        thrust = std::clamp(degrees(2.0 * error + rate) / 100.0, -1.0, 1.0);
      }
      heading += 0.05 * radians(18) * thrust;
    }
    EXPECT_NEAR(one.swarm->heading_rad[0], heading, 1e-9) << window;
  }
}

TEST(Drifter, TakesTheShorterWayRound) {
  OneVehicle one;
  one.run(1.0, ahead(1.0, radians(-170)));
  EXPECT_LT(one.swarm->heading_rad[0], 0.0);
  OneVehicle other;
  other.run(1.0, ahead(1.0, radians(170)));
  EXPECT_GT(other.swarm->heading_rad[0], 0.0);
}

TEST(Drifter, DriftsExactlyWithTheWater) {
  OneVehicle one;
  one.u = 0.1;
  one.v = -0.05;
  one.run(1000.0, {});
  EXPECT_NEAR(one.swarm->x_m[0], 100.0, 1e-9);
  EXPECT_NEAR(one.swarm->y_m[0], -50.0, 1e-9);
  EXPECT_EQ(one.swarm->speed_m_s[0], 0.0);
  EXPECT_EQ(one.swarm->propulsion_j[0], 0.0);
}

TEST(Drifter, DriftsOverGroundButNotThroughTheWaterInACurrent) {
  OneVehicle one;
  one.u = 0.5;
  one.run(30.0, ahead(1.0));
  EXPECT_NEAR(one.swarm->speed_m_s[0], 1.0, 1e-3);
  OneVehicle still;
  still.run(30.0, ahead(1.0));
  EXPECT_NEAR(one.swarm->x_m[0] - still.swarm->x_m[0], 15.0, 1e-9);
}

// The drag map: 26.31 v^2 at multiples of 0.1 m/s, linear between them.
double drag_map(double v) {
  const double low = std::floor(v / 0.1) * 0.1;
  const double high = low + 0.1;
  return 26.31 * (low * low + (v - low) / 0.1 * (high * high - low * low));
}

TEST(Drifter, GlidesToRestAlongTheDragMap) {
  double speed = 1.0, path = 0.0, cubed = 0.0;  // the author's Euler steps of 20 Hz
  for (int k = 0; k < 2400; ++k) {
    const double next = speed - 0.05 * drag_map(speed) / 31.0;
    path += 0.5 * (speed + next) * 0.05;
    cubed += std::pow(0.5 * (speed + next), 3) * 0.05;
    speed = next;
  }
  OneVehicle one;
  one.swarm->speed_m_s[0] = 1.0;
  one.run(120.0, {});
  EXPECT_EQ(one.swarm->speed_m_s[0], 0.0);
  EXPECT_NEAR(one.swarm->x_m[0], path, 0.013);  // the last centimetre is cut off
  const double expected_j = one.energy.power_w / std::pow(one.energy.power_speed_m_s, 3) * cubed;
  EXPECT_NEAR(one.swarm->propulsion_j[0], expected_j, 0.04 * expected_j);  // at five steps a tick
  EXPECT_EQ(one.swarm->y_m[0], 0.0);
}

TEST(Drifter, GlidesTheSameWhetherOrNotItsShortCutApplies) {
  // Below the first knot a tick is two fixed factors; here its five steps are taken one by one.
  OneVehicle shortcut;
  shortcut.swarm->speed_m_s[0] = 0.09;
  shortcut.run(drifter_tick_s, {});
  double speed = 0.09, path = 0.0;
  for (int k = 0; k < 5; ++k) {
    const double next = speed - 0.05 * drag_map(speed) / 31.0;
    path += 0.5 * (speed + next) * 0.05;
    speed = next;
  }
  EXPECT_NEAR(shortcut.swarm->speed_m_s[0], speed, 1e-15);
  EXPECT_NEAR(shortcut.swarm->x_m[0], path, 1e-15);
}

TEST(Drifter, PropulsionAtOneMetrePerSecondDrawsNinetyWatts) {
  OneVehicle one;
  one.run(60.0, ahead(1.0));
  const double before = one.swarm->propulsion_j[0];
  one.run(100.0, ahead(1.0));
  EXPECT_NEAR(one.swarm->propulsion_j[0] - before, 9000.0, 5.0);
}

TEST(Drifter, RisesWhileItThrustsAndIsSlowerMeanwhile) {
  Drifter deep = OneVehicle::quiet();
  deep.start_depth_m = 100.0;
  OneVehicle one(deep);
  one.run(60.0, {});
  EXPECT_EQ(one.swarm->depth_m[0], 100.0);
  one.run(100.0, ahead(1.0));
  // sin 20 deg = 0.342 up, cos 20 deg = 0.940 ahead, less a second for getting up to speed.
  EXPECT_NEAR(100.0 - one.swarm->depth_m[0], 0.342 * 99.2, 0.2);
  EXPECT_NEAR(one.swarm->x_m[0], 0.940 * 99.2, 0.5);
  one.run(300.0, ahead(1.0));
  EXPECT_NEAR(one.swarm->depth_m[0], 0.0, 0.01);
}

TEST(Drifter, HeadingWandersByTwentyDegreesInAMinute) {
  const std::size_t n = 2000;
  Drifter noisy;
  const auto swarm =
      noisy.launch(std::vector<Start>(n, Start{}), Energy{}, RandomStreams(7), drifter_tick_s);
  const std::vector<Command> commands(n);
  const std::vector<double> still(n, 0.0);
  const auto run = [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t tick = from; tick < to; ++tick) {
      swarm->advance(0, n, tick, commands, still, still);
    }
  };
  run(0, 4000);  // until the wandering rate is stationary
  const std::vector<double> before = swarm->heading_rad;
  run(4000, 4240);
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    squares += std::pow(degrees(swarm->heading_rad[i] - before[i]), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / n), 20.0, 1.5);
}

TEST(Drifter, RefusesTicksThatItsStepsDoNotFill) {
  EXPECT_FALSE(Drifter{}.refuses_tick(0.25));
  EXPECT_TRUE(Drifter{}.refuses_tick(0.12));
  EXPECT_TRUE(Drifter{}.refuses_tick(0.4));  // the heading noise is drawn once a second
}

TEST(Drifter, ComplainsOfStepsThatWouldOscillate) {
  Drifter light;
  light.mass_kg = 1.0;
  EXPECT_TRUE(light.complaint());
  EXPECT_FALSE(Drifter{}.complaint());
}

}  // namespace
}  // namespace shoal::scenarios
