// The twelve channels of a vehicle, and what disturbs it.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "shoal/scenarios/estimators/covariance.hpp"
#include "shoal/scenarios/estimators/noise_statistics.hpp"

namespace shoal::scenarios {
namespace {

bool same(const VehicleState& a, const VehicleState& b) {
  for (int i = 0; i < 12; ++i) {
    if (std::isnan(a(i)) != std::isnan(b(i))) return false;
    if (!std::isnan(a(i)) && a(i) != b(i)) return false;
  }
  return true;
}

TEST(SensorMixing, IsSymmetricWithOnesOnItsDiagonal) {
  const VehicleCovariance& S = sensor_mixing();
  EXPECT_EQ(S, S.transpose().eval());
  EXPECT_EQ(S.diagonal(), VehicleState::Ones());
  EXPECT_EQ(S(8, 6), 4e-6);  // z with x and y, not with phi (C54)
  EXPECT_EQ(S(8, 7), 4e-6);
  EXPECT_TRUE((S.row(8).tail<3>().array() == 0.0).all());
  EXPECT_EQ(S(9, 10), 3e-5);
  EXPECT_EQ(S(9, 7), 2e-5);
  EXPECT_EQ(S(0, 11), 5e-7);
  EXPECT_EQ(S(3, 11), 0.0);
  EXPECT_EQ(S(4, 1), 3e-5);
}

TEST(SensorBanks, SameSeedGivesTheSameBitsWhateverOtherVehiclesThereAre) {
  SensorBanks one({}, 1, RandomStreams(4), 0.5);
  SensorBanks many({}, 5, RandomStreams(4), 0.5);
  SensorBanks other({}, 1, RandomStreams(5), 0.5);
  bool other_differs = false, neighbour_differs = false;
  for (std::uint64_t k = 0; k < 300; ++k) {
    const VehicleState neighbour = many.sample(3, k);
    const VehicleState noise = one.sample(0, k);
    EXPECT_TRUE(same(noise, many.sample(0, k))) << k;
    other_differs |= !same(noise, other.sample(0, k));
    neighbour_differs |= !same(noise, neighbour);
  }
  EXPECT_TRUE(other_differs);
  EXPECT_TRUE(neighbour_differs);
}

TEST(SensorBanks, AFaultOfOneChannelLeavesTheOthersAlone) {
  SensorBanks banks({}, 1, RandomStreams(4), 0.5);
  int faults = 0, all_at_once = 0;
  for (std::uint64_t k = 0; k < 5000; ++k) {
    const Eigen::Index missing = banks.sample(0, k).array().isNaN().count();
    faults += static_cast<int>(missing);
    all_at_once += missing > 3 ? 1 : 0;
  }
  EXPECT_GT(faults, 300);  // 12 channels at about 1.4 %
  EXPECT_LT(faults, 1500);
  EXPECT_EQ(all_at_once, 0);
}

TEST(SensorBanks, AnOutageSilencesAllChannelsOfAllVehiclesAndNothingElse) {
  constexpr double period_s = 0.5;
  SensorNoise with_outage;
  with_outage.outage_from_s = 10.0;
  with_outage.outage_s = 60.0;
  SensorNoise silent_noise = with_outage;
  silent_noise.on = false;
  SensorBanks banks(with_outage, 2, RandomStreams(5), period_s);
  SensorBanks exact(silent_noise, 1, RandomStreams(5), period_s);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double t = static_cast<double>(k) * period_s;
    const bool out = t >= 10.0 && t < 70.0;
    EXPECT_EQ(banks.sample(0, k).array().isNaN().all(), out) << t;
    EXPECT_EQ(banks.sample(1, k).array().isNaN().all(), out) << t;
    EXPECT_EQ(exact.sample(0, k).array().isNaN().all(), out) << t;
  }
}

TEST(SensorBanks, ScaleScalesAndOffIsZero) {
  SensorNoise twice, off;
  twice.scale = 2.0;
  off.on = false;
  SensorBanks a({}, 1, RandomStreams(4), 0.5), b(twice, 1, RandomStreams(4), 0.5),
      c(off, 1, RandomStreams(4), 0.5);
  for (std::uint64_t k = 0; k < 100; ++k) {
    EXPECT_TRUE(same(2.0 * a.sample(0, k), b.sample(0, k)));
    EXPECT_EQ(c.sample(0, k), VehicleState::Zero());
  }
}

TEST(SensorBanks, ChannelsOfOneInstrumentAreNearlyIndependent) {
  SensorBanks banks({.faults = false, .rate_limit = RateLimit::per_sample}, 1, RandomStreams(4),
                    0.5);
  constexpr int n = 20'000;
  VehicleCovariance squares = VehicleCovariance::Zero();
  for (std::uint64_t k = 0; k < n; ++k) {
    const VehicleState y = banks.sample(0, k);
    squares += y * y.transpose();
  }
  // Velocity and rate noise hardly remembers: 4 standard errors, and the mixing adds 1e-3 at most.
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double correlation = squares(i, j) / std::sqrt(squares(i, i) * squares(j, j));
      EXPECT_LT(std::abs(correlation), 8.0 / std::sqrt(n)) << i << ' ' << j;
    }
  }
}

TEST(MeasurementCovariance, IsThatOfTheNoiseAsSimulatedNotAsPrinted) {
  const SensorNoise noise;
  const VehicleCovariance R = simulated_measurement_covariance(noise, 0.5, NoiseModel::marginal);
  require_covariance<12>(R, "R_n");
  // Another seed, all twelve channels, many vehicles.
  constexpr std::size_t vehicles = 40;
  constexpr std::uint64_t n = 4000;
  SensorBanks banks(noise, vehicles, RandomStreams(77), 0.5);
  VehicleState squares = VehicleState::Zero(), counts = VehicleState::Zero();
  for (std::size_t v = 0; v < vehicles; ++v) {
    for (std::uint64_t k = 0; k < n; ++k) {
      const VehicleState y = banks.sample(v, k);
      if (k < 500) continue;
      for (int i = 0; i < 12; ++i) {
        if (std::isnan(y(i))) continue;
        squares(i) += y(i) * y(i);
        counts(i) += 1.0;
      }
    }
  }
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(R(i, i) / (squares(i) / counts(i)), 1.0, 0.1) << i;
  }
  EXPECT_EQ(simulated_measurement_covariance({.scale = 3.0}, 0.5, NoiseModel::marginal)(2, 2),
            9.0 * R(2, 2));
  const VehicleCovariance white = simulated_measurement_covariance(noise, 0.5, NoiseModel::white);
  EXPECT_GT(white(6, 6), 3.0 * R(6, 6));  // USBL noise creeps
}

/// Eq. 79 as printed.
BodyCovariance printed_covariance() {
  return BodyCovariance{
      {0.2, 0.01, 0.01, 0, 0.005, 0.005},     {0.01, 0.1, 0.0275, 0.01, 0.003, 0.035},
      {0.01, 0.0275, 0.1, 0.01, 0.003, 0},    {0, 0.01, 0.01, 0.0011, 0.0001, 0.00015},
      {0.005, 0.003, 0.03, 0.0001, 0.002, 0}, {0.005, 0.035, 0, 0.00015, 0, 0.0022}};
}

double smallest_eigenvalue(const BodyCovariance& R) {
  return Eigen::SelfAdjointEigenSolver<BodyCovariance>(0.5 * (R + R.transpose())).eigenvalues()(0);
}

TEST(DisturbanceCovariance, IsPositiveDefiniteWhichThePrintedOneIsNot) {
  const BodyCovariance& R = disturbance_covariance();
  const auto eigenvalues = Eigen::SelfAdjointEigenSolver<BodyCovariance>(R).eigenvalues();
  EXPECT_NEAR(eigenvalues(0), 0.00106, 5e-6);
  EXPECT_NEAR(eigenvalues(5), 0.203, 5e-4);
  EXPECT_EQ(R, R.transpose().eval());

  BodyCovariance printed = printed_covariance();
  EXPECT_THROW(require_covariance<6>(printed, "R_v"), InputError);
  EXPECT_LT(smallest_eigenvalue(printed), -1e-3);
  for (const double wq : {0.003, 0.03}) {  // whichever of the two is meant
    printed(2, 4) = printed(4, 2) = wq;
    EXPECT_THROW(require_covariance<6>(printed, "R_v"), InputError);
  }
  // C55, step by step.
  printed(2, 4) = printed(4, 2) = 0.003;
  printed(1, 5) = printed(5, 1) = 0.0035;
  EXPECT_NEAR(smallest_eigenvalue(printed), -5e-4, 5e-5);
  printed(1, 3) = printed(3, 1) = printed(2, 3) = printed(3, 2) = 0.001;
  EXPECT_EQ(printed, R);
}

TEST(Disturbances, SameSeedGivesTheSameBitsWhateverOtherVehiclesThereAre) {
  Disturbances one({}, 1, RandomStreams(4), 0.5), many({}, 3, RandomStreams(4), 0.5);
  for (std::uint64_t k = 0; k < 100; ++k) {
    many.sample(2, k);
    EXPECT_EQ(one.sample(0, k), many.sample(0, k));
  }
}

TEST(Disturbances, NeverChangeFasterThanTheirRates) {
  Disturbances disturbances({.scale = 0.5}, 1, RandomStreams(4), 0.25);
  BodyAcceleration before = BodyAcceleration::Zero();
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const BodyAcceleration a = disturbances.sample(0, k);
    const BodyAcceleration largest = 0.5 * 0.25 * disturbance_rates();
    EXPECT_TRUE(((a - before).cwiseAbs().array() <= largest.array() * (1.0 + 1e-12)).all());
    before = a;
  }
}

TEST(Disturbances, WithoutALimitHaveTheirCovariance) {
  // So long a period that nothing is limited.
  const BodyCovariance R =
      simulated_disturbance_covariance({.scale = 1.0}, 1e9, NoiseModel::marginal);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double expected = disturbance_covariance()(i, j);
      const double scale =
          std::sqrt(disturbance_covariance()(i, i) * disturbance_covariance()(j, j));
      EXPECT_NEAR(R(i, j), expected, 4.0 * scale * std::sqrt(2.0 / 131072.0));
    }
  }
}

TEST(Disturbances, WithoutALimitHaveNothingInCommonWithThoseBefore) {
  constexpr std::uint64_t n = 4000;
  Disturbances disturbances({.scale = 1.0}, 1, RandomStreams(4), 1e9);
  const Eigen::LLT<BodyCovariance> root(disturbance_covariance());
  std::vector<BodyAcceleration> white;
  for (std::uint64_t k = 0; k < n; ++k) {
    white.emplace_back(root.matrixL().solve(disturbances.sample(0, k)));
  }
  for (std::uint64_t lag = 1; lag <= 2; ++lag) {
    BodyCovariance common = BodyCovariance::Zero();
    for (std::uint64_t k = lag; k < n; ++k) common += white[k] * white[k - lag].transpose();
    EXPECT_LT(common.cwiseAbs().maxCoeff(), 4.5 * std::sqrt(static_cast<double>(n))) << lag;
  }
}

TEST(Disturbances, WithLimitsHaveASmallerStandardDeviation) {
  const BodyCovariance R =
      simulated_disturbance_covariance({.scale = 1.0}, 0.5, NoiseModel::marginal);
  EXPECT_NEAR(std::sqrt(R(0, 0)), 0.17, 0.01);  // m/s^2 in surge, as in independent trials
  const BodyCovariance tenth = simulated_disturbance_covariance({}, 0.5, NoiseModel::marginal);
  EXPECT_LT((tenth - 0.01 * R).norm(), 1e-12);
}

TEST(Disturbances, AreNoneWhenOff) {
  Disturbances off({.on = false}, 1, RandomStreams(4), 0.5);
  EXPECT_EQ(off.sample(0, 0), BodyAcceleration::Zero());
}

}  // namespace
}  // namespace shoal::scenarios
