#include "shoal/scenarios/estimators/estimator.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "shoal/scenarios/estimators/vehicle_filter.hpp"
#include "tests/scenarios/sluggish_vehicle.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::scenarios {
namespace {

constexpr double period_s = 0.5;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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
          const Look& look) {
  std::vector<VehicleState> x(vehicles, VehicleState::Zero());
  const RandomStreams random(seed);
  const auto navigation = how.launch(x, {}, random, period_s);
  Disturbances disturbances({}, vehicles, random, period_s);
  for (std::uint64_t k = 0; k < samples; ++k) {
    for (std::size_t v = 0; v < vehicles; ++v) {
      const double phase = static_cast<double>(k) * 0.01 + static_cast<double>(v);
      tests::SluggishVehicle model{period_s, 1.2 + 0.4 * std::sin(phase),
                                   0.05 * (static_cast<double>((k / 60 + v) % 3) - 1.0)};
      if (k > 0) {
        tests::SluggishVehicle disturbed = model;
        disturbed.disturbance = disturbances.sample(v, k - 1);
        x[v] = disturbed(x[v]);
      }
      look(v, k, x[v], navigation->sample(v, k, x[v], model));
    }
  }
}

/// Mean NEES and rms errors, of estimates and of measurements, once the filter has settled.
struct Quality {
  double nees = 0.0;
  VehicleState estimate_error = VehicleState::Zero(), sensor_error = VehicleState::Zero();
  UkfStatus worst = UkfStatus::ok;
};

Quality quality(const std::vector<std::pair<std::string, std::string>>& words) {
  Quality q;
  double n = 0.0;
  VehicleState measured = VehicleState::Zero();
  sail(*estimator("ukf", words), 8, 1200, 3,
       [&](std::size_t, std::uint64_t k, const VehicleState& truth, const Estimate& estimate) {
         q.worst = std::max(q.worst, estimate.status);
         if (k < 100) return;
         q.nees += estimate.nees;
         q.estimate_error += error(estimate, truth).cwiseAbs2();
         n += 1.0;
         for (int i = 0; i < 12; ++i) {
           const double e = estimate.measured(i) - truth(i);
           if (std::isnan(e)) continue;
           q.sensor_error(i) += e * e;
           measured(i) += 1.0;
         }
       });
  q.nees /= n;
  q.estimate_error = (q.estimate_error / n).cwiseSqrt();
  q.sensor_error = q.sensor_error.cwiseQuotient(measured).cwiseSqrt();
  return q;
}

TEST(Estimators, AreEnrolled) {
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
  const Quality q = quality({});
  EXPECT_EQ(q.worst, UkfStatus::ok);
  for (int i = 0; i < 12; ++i) EXPECT_LT(q.estimate_error(i), q.sensor_error(i)) << i;
  for (int i = 3; i < 6; ++i) EXPECT_LT(q.estimate_error(i), 0.5 * q.sensor_error(i)) << i;
  // The noise is not white: a filter cannot have the 12 of the book, but keeps to the safe side.
  EXPECT_LT(q.nees, 12.0);
  EXPECT_GT(q.nees, 4.0);
}

TEST(UkfEstimator, IsTooSureOfItselfIfTheMemoryOfTheNoiseIsLeftOut) {
  const Quality q = quality({{"measurement_noise", "marginal"}});
  EXPECT_GT(q.nees, 48.0);
  const Quality white = quality({});
  EXPECT_LT(white.estimate_error(6), q.estimate_error(6));
}

TEST(UkfEstimator, EveryPropagationKeepsItsCourse) {
  for (const char* propagation : {"kinematic", "recentred", "full"}) {
    const Quality q = quality({{"propagation", propagation}});
    EXPECT_EQ(q.worst, UkfStatus::ok) << propagation;
    EXPECT_LT(q.nees, 12.0) << propagation;
    EXPECT_LT(q.estimate_error(6), q.sensor_error(6)) << propagation;
  }
}

TEST(UkfEstimator, FollowsThePropagationThatIsAskedFor) {
  const auto calls = [](const char* propagation) {
    const auto how = estimator("ukf", {{"propagation", propagation}});
    const auto navigation = how->launch({VehicleState::Zero()}, {}, RandomStreams(1), period_s);
    int count = 0;
    const auto model = [&count](const VehicleState& x) {
      ++count;
      return KinematicModel{period_s}(x);
    };
    navigation->sample(0, 0, VehicleState::Zero(), model);
    EXPECT_EQ(count, 0);  // nothing has passed yet
    navigation->sample(0, 1, VehicleState::Zero(), model);
    return count;
  };
  EXPECT_EQ(calls("kinematic"), 0);
  EXPECT_EQ(calls("recentred"), 1);
  EXPECT_EQ(calls("full"), 25);
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
  const auto navigation = how->launch({x}, {.on = false}, RandomStreams(1), period_s);
  const tests::SluggishVehicle model{period_s, 1.0, 0.1};
  for (std::uint64_t k = 0; k < 200; ++k) {
    if (k > 0) x = model(x);
    const Estimate& estimate = navigation->sample(0, k, x, model);
    EXPECT_LT(error(estimate, x).norm(), 0.02) << k;
    EXPECT_EQ(estimate.used, 12);
  }
}

UkfSettings<12, 12> settings() {
  const VehicleFilterOptions options;
  UkfSettings<12, 12> made;
  made.process_covariance = options.process_covariance({}, period_s);
  made.measurement_covariance = options.measurement_covariance(period_s);
  made.state_is_angle = made.measurement_is_angle = vehicle_angles;
  return made;
}

TEST(VehicleFilter, HeadingCrossesSouthWithoutAJump) {
  // psi = pi is south: twenty turns.
  VehicleState x = VehicleState::Zero();
  x(0) = 1.0;
  x(5) = 0.2;
  VehicleFilter filter(settings(), x);
  for (int k = 0; k < 1260; ++k) {
    x = KinematicModel{period_s}(x);
    VehicleState measured = x;
    measured(11) = wrapped(x(11));
    filter.predict(KinematicModel{period_s});
    const Estimate& estimate = filter.correct(measured, x);
    // The mean turn is smaller than that of the mean attitude, by the cosine of an uncertain roll.
    ASSERT_LT(std::abs(error(estimate, x)(11)), 1e-3) << k;
    ASSERT_LT(error(estimate, x).segment<2>(6).norm(), 0.05) << k;
    ASSERT_EQ(estimate.status, UkfStatus::ok);
  }
}

TEST(VehicleFilter, KnowsLessAndLessOfAChannelAtFault) {
  VehicleFilter filter(settings(), VehicleState::Zero());
  VehicleState measured = VehicleState::Zero();
  measured(8) = nan;
  double before = 0.0;
  for (int k = 0; k < 60; ++k) {
    filter.predict(KinematicModel{period_s});
    const Estimate& estimate = filter.correct(measured, VehicleState::Zero());
    EXPECT_GT(estimate.sd(8), before);
    EXPECT_TRUE(estimate.faulty[8]);
    EXPECT_TRUE(std::isnan(estimate.innovation(8)));
    EXPECT_EQ(estimate.used, 11);
    before = estimate.sd(8);
  }
}

TEST(VehicleFilter, ALostFilterSaysSoAndStartsAgainFromItsSensors) {
  VehicleFilter filter(settings(), VehicleState::Zero());
  VehicleState measured = VehicleState::Constant(0.1);
  measured(7) = nan;
  filter.predict([](const VehicleState&) { return VehicleState(VehicleState::Constant(nan)); });
  const Estimate& lost = filter.correct(measured, VehicleState::Zero());
  EXPECT_EQ(lost.status, UkfStatus::lost);
  EXPECT_EQ(lost.state(6), 0.1);
  EXPECT_TRUE(std::isfinite(lost.state(7)));
  filter.predict(KinematicModel{period_s});
  EXPECT_EQ(filter.correct(measured, VehicleState::Zero()).status, UkfStatus::ok);
}

TEST(VehicleFilter, AllocatesNothing) {
  const auto how = estimator("ukf");
  VehicleState x = VehicleState::Zero();
  const auto navigation = how->launch({x}, {}, RandomStreams(1), period_s);
  const tests::SluggishVehicle model{period_s, 1.0, 0.1};
  navigation->sample(0, 0, x, model);
  const std::size_t before = tests::heap_requests();
  for (std::uint64_t k = 1; k < 300; ++k) {
    x = model(x);
    navigation->sample(0, k, x, model);
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
  assign(table, "scaling.kappa", {-12.0, {}});
  const auto how = Registry<Estimator>::instance().make("ukf", table, "estimator.ukf");
  EXPECT_THROW(how->launch({VehicleState::Zero()}, {}, RandomStreams(1), period_s), InputError);
  EXPECT_THROW(estimator("ukf")->launch({VehicleState::Zero()}, {}, RandomStreams(1), 0.0),
               InputError);
}

}  // namespace
}  // namespace shoal::scenarios
