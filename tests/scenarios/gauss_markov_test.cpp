#include "shoal/scenarios/estimators/gauss_markov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shoal/core/error.hpp"
#include "shoal/scenarios/estimators/noise_statistics.hpp"
#include "shoal/scenarios/estimators/sensor_noise.hpp"

namespace shoal::scenarios {
namespace {

constexpr std::array<Sensor, 5> kinds{Sensor::velocity, Sensor::rate, Sensor::position,
                                      Sensor::depth, Sensor::attitude};

TEST(SensorTables, RowsAddUpToOne) {
  for (const Sensor kind : kinds) {
    const GaussMarkov::Matrix& T = sensor_model(kind).transition();
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(T.row(i).sum(), 1.0, 1e-15);
  }
}

TEST(SensorTables, PlusAndMinusAreMirrorImages) {
  constexpr std::array<int, 6> mirror{0, 2, 1, 4, 3, 5};
  for (const Sensor kind : kinds) {
    const GaussMarkov& model = sensor_model(kind);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        const auto m = [&](int k) { return mirror[static_cast<std::size_t>(k)]; };
        EXPECT_NEAR(model.transition()(i, j), model.transition()(m(i), m(j)), 1e-15);
      }
    }
    for (std::size_t i = 0; i < 5; ++i) {
      const Grade& other = model.grades()[static_cast<std::size_t>(mirror[i])];
      EXPECT_EQ(model.grades()[i].mean, -other.mean);
      EXPECT_EQ(model.grades()[i].sd, other.sd);
      EXPECT_EQ(model.grades()[i].rate, other.rate);
    }
  }
}

/// Nominal, +-reliable each, +-unreliable each, fault, of each sensor.
const std::array<std::array<double, 4>, 5> shares{{{0.641, 0.139, 0.033, 0.0142},
                                                   {0.546, 0.172, 0.048, 0.0133},
                                                   {0.435, 0.209, 0.070, 0.0073},
                                                   {0.449, 0.214, 0.058, 0.0057},
                                                   {0.421, 0.211, 0.066, 0.0246}}};

TEST(SensorTables, StationarySharesAreThoseOfTheSpecification) {
  for (const Sensor kind : kinds) {
    const GaussMarkov::Shares found = sensor_model(kind).stationary();
    const auto& expected = shares[static_cast<std::size_t>(kind)];
    EXPECT_NEAR(found(0), expected[0], 5.1e-4);
    for (const int i : {1, 2}) EXPECT_NEAR(found(i), expected[1], 5.1e-4);
    for (const int i : {3, 4}) EXPECT_NEAR(found(i), expected[2], 5.1e-4);
    EXPECT_NEAR(found(5), expected[3], 5.1e-5);
    EXPECT_NEAR(found.sum(), 1.0, 1e-14);
    const GaussMarkov::Shares next = sensor_model(kind).transition().transpose() * found;
    EXPECT_LT((next - found).norm(), 1e-15);
  }
}

constexpr std::uint64_t samples = 200'000;

/// Runs a channel; `look` sees the channel and the sample.
template <class Look>
void run(const GaussMarkov& model, double steps, std::uint64_t count, const Look& look) {
  const RandomStreams random(21);
  GaussMarkov::Channel channel;
  for (std::uint64_t k = 0; k < count; ++k) {
    const double u = random.uniform(Purpose::sensor_state, 0, k)[0];
    const double z = random.normal(Purpose::sensor_noise, 0, k)[0];
    look(channel, model.next(channel, u, z, steps));
  }
}

TEST(GaussMarkov, VisitsItsStatesInTheirStationaryShares) {
  for (const Sensor kind : kinds) {
    const GaussMarkov& model = sensor_model(kind);
    GaussMarkov::Shares found = GaussMarkov::Shares::Zero();
    run(model, 1.0, samples, [&](const auto& channel, double) { found(channel.state) += 1.0; });
    found /= static_cast<double>(samples);
    const GaussMarkov::Shares expected = model.stationary();
    for (int i = 0; i < 6; ++i) {
      // States last a little longer than one sample: their memory is less than a factor of 2.
      const double error = std::sqrt(2.0 * expected(i) * (1.0 - expected(i)) / samples);
      EXPECT_NEAR(found(i), expected(i), 4.0 * error) << i;
    }
  }
}

/// Nominal for ever.
GaussMarkov single(double sd, double rate) {
  GaussMarkov::Matrix T = GaussMarkov::Matrix::Zero();
  T.col(0).setOnes();
  return {{0.0, sd, rate}, {0.0, sd, rate}, {0.0, sd, rate}, T};
}

TEST(GaussMarkov, ARateLimitLeavesAStandardDeviationThatFollowsFromTheStep) {
  // The formula sqrt(sqrt(pi / 8) delta sigma) holds for small steps; at .012 independent
  // trials gave 0.0872.
  const auto sd = [](double step) {
    return std::sqrt(simulated_statistics(single(1.0, step), 1.0).variance);
  };
  const auto formula = [](double step) {
    return std::sqrt(std::sqrt(std::numbers::pi / 8.0) * step);
  };
  EXPECT_NEAR(formula(0.012), 0.0867, 5e-5);
  // 128 batches of 1024 samples with a memory of 2 sqrt(pi / 2) / .012 = 209 samples: 628
  // independent ones.
  EXPECT_NEAR(sd(0.012), 0.0872, 0.0872 * 4.0 / std::sqrt(2.0 * 628.0));
  EXPECT_NEAR(sd(0.1) / formula(0.1), 1.0, 0.06);
  EXPECT_NEAR(sd(1e9), 1.0, 4.0 / std::sqrt(2.0 * 131072.0));  // no limit
}

TEST(GaussMarkov, WithoutALimitTheNoiseIsWhiteAndWithOneItIsNot) {
  const ChannelStatistics free = simulated_statistics(single(1.0, 1e9), 1.0);
  EXPECT_NEAR(free.white / free.variance, 1.0, 4.0 * std::sqrt(2.0 / 128.0));
  const ChannelStatistics limited = simulated_statistics(single(1.0, 0.1), 1.0);
  // Small deviations decay as exp(-sqrt(2 / pi) .1 k): summed over both sides, 25 samples.
  EXPECT_NEAR(limited.white / limited.variance, 25.0, 25.0 * 4.0 * std::sqrt(2.0 / 128.0));
}

TEST(GaussMarkov, NeverStepsFurtherThanItsRateAllows) {
  for (const Sensor kind : kinds) {
    const GaussMarkov& model = sensor_model(kind);
    double before = 0.0;
    bool reached = false;
    run(model, 0.5, 5000, [&](const auto& channel, double y) {
      if (std::isnan(y)) {
        before = 0.0;  // a channel starts from 0 again after a fault
        return;
      }
      const double step = 0.5 * model.grades()[static_cast<std::size_t>(channel.state)].rate;
      EXPECT_LE(std::abs(y - before), step * (1.0 + 1e-12));
      reached |= std::abs(y - before) > 0.999 * step;
      before = y;
    });
    EXPECT_TRUE(reached);
  }
}

TEST(GaussMarkov, MeasuresNothingInAFaultAndOnlyThen) {
  int faults = 0;
  run(sensor_model(Sensor::attitude), 1.0, 20'000, [&](const auto& channel, double y) {
    EXPECT_EQ(std::isnan(y), channel.state == GaussMarkov::fault);
    faults += std::isnan(y) ? 1 : 0;
  });
  EXPECT_GT(faults, 300);
  run(sensor_model(Sensor::attitude).without_faults(), 1.0, 20'000,
      [&](const auto&, double y) { EXPECT_FALSE(std::isnan(y)); });
}

TEST(GaussMarkov, LimitsAreRatesOrSteps) {
  EXPECT_EQ(step_per_rate(RateLimit::per_second, 0.5), 0.5);
  EXPECT_EQ(step_per_rate(RateLimit::per_sample, 0.5), 1.0);
  EXPECT_EQ(rate_limited(1.0, 5.0, 0.25), 1.25);
  EXPECT_EQ(rate_limited(1.0, -5.0, 0.25), 0.75);
  EXPECT_EQ(rate_limited(1.0, 1.1, 0.25), 1.1);
}

TEST(GaussMarkov, RefusesRowsThatAreNoProbabilities) {
  GaussMarkov::Matrix T = GaussMarkov::Matrix::Constant(1.0 / 6.0);
  T(2, 3) += 0.01;
  EXPECT_THROW(GaussMarkov({0, 1, 1}, {0, 1, 1}, {0, 1, 1}, T), InputError);
  T = GaussMarkov::Matrix::Identity();
  T(1, 0) = -0.5;
  T(1, 1) = 1.5;
  EXPECT_THROW(GaussMarkov({0, 1, 1}, {0, 1, 1}, {0, 1, 1}, T), InputError);
}

}  // namespace
}  // namespace shoal::scenarios
