#include "shoal/scenarios/estimators/estimator.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "shoal/scenarios/estimators/vehicle_filter.hpp"
#include "tests/scenarios/sluggish_vehicle.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/nan_value.hpp"

namespace shoal::scenarios {
namespace {

constexpr double cycle_s = 0.5;
const Eigen::Vector2d still_water = Eigen::Vector2d::Zero();
using shoal::tests::nan_value;

std::unique_ptr<Estimator> estimator(
    const std::string& kind, const std::vector<std::pair<std::string, std::string>>& words = {}) {
  Setting table;
  for (const auto& [key, word] : words) assign(table, key, {word, {}});
  return Registry<Estimator>::instance().make(kind, table, "estimator." + kind);
}

VehicleState error(const Estimate& estimate, const VehicleState& truth) {
  VehicleState e = estimate.state - truth;
  for (int i = 9; i < 12; ++i) e(i) = wrapped(e(i));
  return e;
}

/// Disturbed vehicles that speed up, slow down and turn; `look` sees (vehicle, k, truth, estimate).
template <class Look>
void sail(const Estimator& how, std::size_t vehicles, std::uint64_t samples, std::uint64_t seed,
          const Look& look, const Eigen::Vector2d& water = still_water) {
  std::vector<VehicleState> x(vehicles, VehicleState::Zero());
  const RandomStreams random(seed);
  const auto navigation = how.launch(x, {}, random, cycle_s);
  Disturbances disturbances({}, vehicles, random, cycle_s);
  for (std::uint64_t k = 0; k < samples; ++k) {
    for (std::size_t v = 0; v < vehicles; ++v) {
      const double phase = static_cast<double>(k) * 0.01 + static_cast<double>(v);
      tests::SluggishVehicle model{cycle_s, 1.2 + 0.4 * std::sin(phase),
                                   0.05 * (static_cast<double>((k / 60 + v) % 3) - 1.0)};
      if (k > 0) {
        tests::SluggishVehicle disturbed = model;
        disturbed.disturbance = disturbances.sample(v, k - 1);
        x[v] = disturbed(x[v], water);
      }
      look(v, k, x[v], navigation->sample(v, k, x[v], water, model));
    }
  }
}

/// Mean NEES and rms errors, of estimates and of measurements, once the filter has settled.
struct Quality {
  double nees = 0.0;
  VehicleState estimate_error = VehicleState::Zero(), sensor_error = VehicleState::Zero();
  double water_error = 0.0;
  UkfStatus worst = UkfStatus::ok;
};

Quality quality(const Estimator& how, const Eigen::Vector2d& water = still_water) {
  Quality q;
  double n = 0.0;
  VehicleState measured = VehicleState::Zero();
  const auto look = [&](std::size_t, std::uint64_t k, const VehicleState& truth,
                        const Estimate& estimate) {
    q.worst = std::max(q.worst, estimate.status);
    if (k < 100) return;
    q.water_error += (estimate.water - water).squaredNorm();
    q.nees += estimate.nees;
    q.estimate_error += error(estimate, truth).cwiseAbs2();
    n += 1.0;
    for (int i = 0; i < 12; ++i) {
      const double e = estimate.measured(i) - truth(i);
      if (std::isnan(e)) continue;
      q.sensor_error(i) += e * e;
      measured(i) += 1.0;
    }
  };
  sail(how, 8, 1200, 3, look, water);
  q.nees /= n;
  q.water_error = std::sqrt(q.water_error / n);
  q.estimate_error = (q.estimate_error / n).cwiseSqrt();
  q.sensor_error = q.sensor_error.cwiseQuotient(measured).cwiseSqrt();
  return q;
}

Quality quality(const std::vector<std::pair<std::string, std::string>>& words,
                const Eigen::Vector2d& water = still_water) {
  return quality(*estimator("ukf", words), water);
}

TEST(Estimators, AreRegistered) {
  EXPECT_EQ(Registry<Estimator>::instance().names(), (std::vector<std::string>{"perfect", "ukf"}));
}

TEST(PerfectEstimator, IsTheTruth) {
  sail(*estimator("perfect"), 2, 50, 1,
       [](std::size_t, std::uint64_t, const VehicleState& truth, const Estimate& estimate) {
         EXPECT_EQ(estimate.state, truth);
         EXPECT_EQ(estimate.measured, truth);
         EXPECT_EQ(estimate.nees, 0.0);
         EXPECT_TRUE(estimate.faulty.none());
       });
}

TEST(UkfEstimator, IsBetterThanItsSensorsAndKnowsHowGoodItIs) {
  const Quality q = quality(*estimator("ukf", {}));
  EXPECT_EQ(q.worst, UkfStatus::ok);
  for (int i = 0; i < 12; ++i) EXPECT_LT(q.estimate_error(i), q.sensor_error(i)) << i;
  for (int i = 3; i < 6; ++i) EXPECT_LT(q.estimate_error(i), 0.5 * q.sensor_error(i)) << i;
  // 8 vehicles with 14 states: 95 % of means lie between 0.75 and 1.28 per state.
  EXPECT_GT(q.nees, 0.75 * 14);
  EXPECT_LT(q.nees, 1.28 * 14);
}

TEST(UkfEstimator, KnowsTheCurrentAndHowWell) {
  for (const char* doppler : {"water_track", "bottom_track"}) {
    for (const double speed : {0.1, 0.3, 0.5}) {
      const Quality q = quality({{"doppler", doppler}}, speed * Eigen::Vector2d(0.6, 0.8));
      EXPECT_EQ(q.worst, UkfStatus::ok);
      EXPECT_GT(q.nees, 0.75 * 14) << doppler << ' ' << speed;
      EXPECT_LT(q.nees, 1.28 * 14) << doppler << ' ' << speed;
      EXPECT_LT(q.water_error, 0.1) << doppler << ' ' << speed;
    }
  }
}

TEST(UkfEstimator, IsLostInACurrentThatItTakesForStillWater) {
  Setting table;
  assign(table, "water.sd_m_s", {0.0, {}});
  const auto how = Registry<Estimator>::instance().make("ukf", table, "estimator.ukf");
  const Quality q = quality(*how, {0.3, 0.0});
  EXPECT_GT(q.nees, 100.0);
}

TEST(UkfEstimator, WhatADopplerLogShowsOverGroundIsTheSumOfBothVelocities) {
  VehicleFilterOptions options;
  const VehicleState x =
      (VehicleState() << 1, 0.2, 0.1, 0, 0, 0, 3, 4, 5, 0.1, -0.2, 2.0).finished();
  const Eigen::Vector2d water(0.3, -0.2);
  const auto shown = [&](VehicleFilterOptions::Doppler doppler) {
    options.doppler = doppler;
    return VehicleFilter(options, options.settings({}, cycle_s), x, cycle_s).measured(x, water);
  };
  EXPECT_EQ(shown(VehicleFilterOptions::Doppler::water_track), x);
  const VehicleState over_ground = shown(VehicleFilterOptions::Doppler::bottom_track);
  EXPECT_EQ(over_ground.tail<9>(), x.tail<9>());
  Eigen::Vector3d expected = KinematicModel::velocity(x.tail<3>(), x.head<3>());
  expected.head<2>() += water;
  EXPECT_LT((KinematicModel::velocity(x.tail<3>(), over_ground.head<3>()) - expected).norm(),
            1e-14);
}

TEST(UkfEstimator, IsTooSureOfItselfIfTheMemoryOfTheNoiseIsLeftOut) {
  const Quality q = quality({{"measurement_noise", "marginal"}});
  EXPECT_GT(q.nees, 48.0);
  const Quality white = quality(*estimator("ukf", {}));
  EXPECT_LT(white.estimate_error(6), q.estimate_error(6));
}

TEST(UkfEstimator, EveryPropagationKeepsItsCourse) {
  for (const char* propagation : {"kinematic", "linearised", "full"}) {
    const Quality q = quality({{"propagation", propagation}});
    EXPECT_EQ(q.worst, UkfStatus::ok) << propagation;
    if (propagation != std::string("kinematic")) {
      EXPECT_LT(q.nees, 1.28 * 14) << propagation;
    }
    EXPECT_LT(q.estimate_error(6), q.sensor_error(6)) << propagation;
  }
}

TEST(UkfEstimator, FollowsThePropagationThatIsAskedFor) {
  const auto calls = [](const char* propagation) {
    const auto how = estimator("ukf", {{"propagation", propagation}});
    const auto navigation = how->launch({VehicleState::Zero()}, {}, RandomStreams(1), cycle_s);
    int count = 0;
    struct Counted {
      int& count;
      VehicleState operator()(const VehicleState& x, const Eigen::Vector2d& water) const {
        ++count;
        return KinematicModel{cycle_s}(x, water);
      }
      BodyTangent tangent(const VehicleState&) const { return BodyTangent::Zero(); }
    };
    const Counted model{count};
    navigation->sample(0, 0, VehicleState::Zero(), still_water, model);
    EXPECT_EQ(count, 0);  // nothing has passed yet
    navigation->sample(0, 1, VehicleState::Zero(), still_water, model);
    return count;
  };
  EXPECT_EQ(calls("kinematic"), 0);
  EXPECT_EQ(calls("linearised"), 1);
  EXPECT_EQ(calls("full"), 29);
}

TEST(UkfEstimator, SameSeedGivesTheSameBitsWhateverOtherVehiclesThereAre) {
  const auto states = [](std::size_t vehicles, std::uint64_t seed) {
    std::vector<VehicleState> of_the_first;
    sail(*estimator("ukf"), vehicles, 60, seed,
         [&](std::size_t v, std::uint64_t, const VehicleState&, const Estimate& estimate) {
           if (v == 0) of_the_first.push_back(estimate.state);
         });
    return of_the_first;
  };
  EXPECT_EQ(states(1, 9), states(1, 9));
  EXPECT_EQ(states(1, 9), states(4, 9));
  EXPECT_NE(states(1, 9), states(1, 10));
}

TEST(UkfEstimator, WithoutNoiseOrDisturbanceStaysWithTheTruth) {
  Setting table;
  assign(table, "sensors.on", {false, {}});
  const auto how = Registry<Estimator>::instance().make("ukf", table, "estimator.ukf");
  VehicleState x = VehicleState::Zero();
  const auto navigation = how->launch({x}, {.on = false}, RandomStreams(1), cycle_s);
  const tests::SluggishVehicle model{cycle_s, 1.0, 0.1};
  for (std::uint64_t k = 0; k < 200; ++k) {
    if (k > 0) x = model(x);
    const Estimate& estimate = navigation->sample(0, k, x, still_water, model);
    EXPECT_LT(error(estimate, x).norm(), 0.02) << k;
    EXPECT_EQ(estimate.used, 12);
  }
}

/// That has no model of forces.
VehicleFilter kinematic_filter(const VehicleState& start) {
  VehicleFilterOptions options;
  options.model_error_m_s2 = 0.02;
  options.model_error_rad_s2 = 0.005;
  return {options, options.settings({}, cycle_s), start, cycle_s};
}

TEST(VehicleFilter, HeadingCrossesSouthWithoutAJump) {
  // psi = pi is south: twenty turns.
  VehicleState x = VehicleState::Zero();
  x(0) = 1.0;
  x(5) = 0.2;
  VehicleFilter filter = kinematic_filter(x);
  for (int k = 0; k < 1260; ++k) {
    x = KinematicModel{cycle_s}(x);
    VehicleState measured = x;
    measured(11) = wrapped(x(11));
    filter.predict(KinematicModel{cycle_s});
    const Estimate& estimate = filter.correct(measured, x, still_water);
    // The mean turn is smaller than that of the mean attitude, by the cosine of an uncertain roll.
    ASSERT_LT(std::abs(error(estimate, x)(11)), 1e-3) << k;
    ASSERT_LT(error(estimate, x).segment<2>(6).norm(), 0.05) << k;
    ASSERT_LT(estimate.nees, 1.0) << "the truth's heading is not wrapped";
    ASSERT_EQ(estimate.status, UkfStatus::ok);
  }
}

TEST(VehicleFilter, KnowsLessAndLessOfAChannelAtFault) {
  VehicleFilter filter = kinematic_filter(VehicleState::Zero());
  VehicleState measured = VehicleState::Zero();
  measured(8) = nan_value;
  double before = 0.0;
  for (int k = 0; k < 60; ++k) {
    filter.predict(KinematicModel{cycle_s});
    const Estimate& estimate = filter.correct(measured, VehicleState::Zero(), still_water);
    EXPECT_GT(estimate.sd(8), before);
    EXPECT_TRUE(estimate.faulty[8]);
    EXPECT_TRUE(std::isnan(estimate.innovation(8)));
    EXPECT_EQ(estimate.used, 11);
    before = estimate.sd(8);
  }
}

TEST(VehicleFilter, ALostFilterSaysSoAndStartsAgainFromItsSensors) {
  VehicleFilter filter = kinematic_filter(VehicleState::Zero());
  VehicleState measured = VehicleState::Constant(0.1);
  measured(7) = nan_value;
  filter.predict(
      [](const VehicleBelief&) { return VehicleBelief(VehicleBelief::Constant(nan_value)); });
  const Estimate& lost = filter.correct(measured, VehicleState::Zero(), still_water);
  EXPECT_EQ(lost.status, UkfStatus::lost);
  EXPECT_EQ(lost.state(6), 0.1);
  EXPECT_TRUE(std::isfinite(lost.state(7)));
  filter.predict(KinematicModel{cycle_s});
  EXPECT_EQ(filter.correct(measured, VehicleState::Zero(), still_water).status, UkfStatus::ok);
}

TEST(VehicleFilter, AllocatesNothing) {
  const auto how = estimator("ukf");
  VehicleState x = VehicleState::Zero();
  const auto navigation = how->launch({x}, {}, RandomStreams(1), cycle_s);
  const tests::SluggishVehicle model{cycle_s, 1.0, 0.1};
  navigation->sample(0, 0, x, still_water, model);
  const std::size_t before = tests::heap_requests();
  for (std::uint64_t k = 1; k < 300; ++k) {
    x = model(x);
    navigation->sample(0, k, x, still_water, model);
  }
  EXPECT_EQ(tests::heap_requests() - before, 0u);
}

TEST(VehicleFilterOptions, NameWhatIsWrong) {
  try {
    estimator("ukf", {{"propagation", "kinmatic"}});
    ADD_FAILURE() << "took it";
  } catch (const InputError& wrong) {
    EXPECT_NE(std::string(wrong.what()).find("estimator.ukf.propagation"), std::string::npos);
    EXPECT_NE(std::string(wrong.what()).find("kinematic"), std::string::npos) << wrong.what();
  }
  Setting table;
  assign(table, "scaling.kappa", {-14.0, {}});
  const auto how = Registry<Estimator>::instance().make("ukf", table, "estimator.ukf");
  EXPECT_THROW(how->launch({VehicleState::Zero()}, {}, RandomStreams(1), cycle_s), InputError);
  EXPECT_THROW(estimator("ukf")->launch({VehicleState::Zero()}, {}, RandomStreams(1), 0.0),
               InputError);
}

}  // namespace
}  // namespace shoal::scenarios
