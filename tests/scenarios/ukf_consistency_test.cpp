// Whether the filter's covariance is that of its errors: NEES and NIS over many runs.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <boost/math/distributions/chi_squared.hpp>

#include "shoal/core/random.hpp"
#include "shoal/scenarios/estimators/ukf.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr int runs = 4000;
constexpr int cycles = 40;

/// Position and velocity in the plane; positions are measured.
Vector4d glide(const Vector4d& x) {
  return {x(0) + 0.5 * x(2), x(1) + 0.5 * x(3), 0.98 * x(2), 0.98 * x(3)};
}

Vector4d normals(std::uint32_t run, std::uint64_t index) {
  const RandomStreams random(11);
  const auto [a, b] = random.normal(Purpose::process_noise, run, 2 * index);
  const auto [c, d] = random.normal(Purpose::process_noise, run, 2 * index + 1);
  return {a, b, c, d};
}

struct Consistency {
  double nees = 0.0, nis = 0.0;  // sums over the runs, at the last step
};

/// The filter assumes `assumed` times the variance that the process noise has.
Consistency consistency(double assumed) {
  UkfSettings<4, 2> settings;
  const Vector4d process_sd(0.02, 0.02, 0.05, 0.05);
  const Vector2d sensor_sd(0.7, 0.5);
  const Vector4d start_sd(1.0, 1.0, 0.3, 0.3);
  settings.process_covariance = assumed * Matrix4d(process_sd.cwiseAbs2().asDiagonal());
  settings.measurement_covariance = sensor_sd.cwiseAbs2().asDiagonal();
  settings.gate.sigma = 0.0;  // a gate cuts the tails of the innovations
  Consistency sum;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const Vector4d start(0.0, 0.0, 1.0, -0.5);
    Vector4d truth = start + start_sd.cwiseProduct(normals(run, 0));
    Ukf<4, 2> ukf(settings, start, start_sd.cwiseAbs2().asDiagonal());
    double nis = 0.0;
    for (std::uint64_t k = 1; k <= cycles; ++k) {
      truth = glide(truth) + process_sd.cwiseProduct(normals(run, 2 * k));
      ukf.predict(glide);
      const Vector2d y =
          truth.head<2>() + sensor_sd.cwiseProduct(normals(run, 2 * k + 1).head<2>());
      nis = ukf.correct(y, [](const Vector4d& x) -> Vector2d { return x.head<2>(); }).nis;
    }
    Vector4d e = truth - ukf.state();
    ukf.root().triangularView<Eigen::Lower>().solveInPlace(e);
    sum.nees += e.squaredNorm();
    sum.nis += nis;
  }
  return sum;
}

/// The share of chi-squared below; inside the two-sided 95 % band from .025 to .975.
double below(double sum, int degrees) {
  return boost::math::cdf(boost::math::chi_squared(degrees), sum);
}

TEST(UkfConsistency, NeesAndNisLieInTheirBandsWhenTheNoiseIsAsAssumed) {
  const Consistency found = consistency(1.0);
  EXPECT_GT(below(found.nees, 4 * runs), 0.025) << found.nees / runs;
  EXPECT_LT(below(found.nees, 4 * runs), 0.975) << found.nees / runs;
  EXPECT_GT(below(found.nis, 2 * runs), 0.025) << found.nis / runs;
  EXPECT_LT(below(found.nis, 2 * runs), 0.975) << found.nis / runs;
}

TEST(UkfConsistency, NeesLeavesItsBandWhenTheNoiseIsNotAsAssumed) {
  EXPECT_GT(below(consistency(0.25).nees, 4 * runs), 0.999);  // too sure of itself
  EXPECT_LT(below(consistency(4.0).nees, 4 * runs), 0.001);   // too doubtful
}

/// Measurements of position whose noise has a memory; some are missing.
struct Remembering {
  static constexpr double phi_x = 0.9, phi_y = 0.6;
  const Vector2d sd{0.7, 0.5}, phi{phi_x, phi_y};
  Vector2d noise = Vector2d::Zero();

  Vector2d next(const Vector2d& normal) {
    const Vector2d kick = sd.array() * (1.0 - phi.array().square()).sqrt() * normal.array();
    return noise = phi.cwiseProduct(noise) + kick;
  }
};

UkfSettings<4, 2> remembering_settings(bool knows) {
  const Remembering sensor;
  UkfSettings<4, 2> settings;
  settings.process_covariance = Vector4d(4e-4, 4e-4, 25e-4, 25e-4).asDiagonal();
  settings.measurement_covariance = sensor.sd.cwiseAbs2().asDiagonal();
  if (knows) settings.measurement_memory = sensor.phi;
  settings.gate.sigma = 0.0;
  return settings;
}

/// The same problem for the plain Kalman filter: the noise is two more states, and a measurement
/// shows position and noise without any error of its own (R = 0).
struct AugmentedKalman {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Vector6 x = Vector6::Zero();
  Matrix6 P = Matrix6::Zero(), F = Matrix6::Identity(), Q = Matrix6::Zero();
  Eigen::Matrix<double, 2, 6> H = Eigen::Matrix<double, 2, 6>::Zero();

  AugmentedKalman(const Vector4d& start, const Matrix4d& P0) {
    const Remembering sensor;
    x.head<4>() = start;
    P.topLeftCorner<4, 4>() = P0;
    P.diagonal().tail<2>() = sensor.sd.cwiseAbs2();
    F(0, 2) = F(1, 3) = 0.5;
    F(2, 2) = F(3, 3) = 0.98;
    F(4, 4) = sensor.phi(0);
    F(5, 5) = sensor.phi(1);
    Q.diagonal() << 4e-4, 4e-4, 25e-4, 25e-4,
        sensor.sd.cwiseAbs2().cwiseProduct(Vector2d::Ones() - Vector2d(sensor.phi.cwiseAbs2()));
    H(0, 0) = H(1, 1) = H(0, 4) = H(1, 5) = 1.0;
  }
  void predict() {
    x = F * x;
    P = F * P * F.transpose() + Q;
  }
  void correct(const Vector2d& y) {
    const Eigen::Matrix2d S = H * P * H.transpose();
    const Eigen::Matrix<double, 6, 2> K = P * H.transpose() * S.inverse();
    x += K * (y - H * x);
    P = (Matrix6::Identity() - K * H) * P;
  }
};

TEST(UkfWithRememberingNoise, IsTheKalmanFilterThatEstimatesTheNoise) {
  const Vector4d start(0.0, 0.0, 1.0, -0.5);
  const Matrix4d P0 = Vector4d(1.0, 1.0, 0.1, 0.1).asDiagonal();
  Ukf<4, 2> ukf(remembering_settings(true), start, P0);
  AugmentedKalman kalman(start, P0);
  const auto place = [](const Vector4d& x) -> Vector2d { return x.head<2>(); };
  for (std::uint64_t k = 0; k < 60; ++k) {
    if (k > 0) {
      ukf.predict(glide, place);
      kalman.predict();
    }
    const Vector2d y = 3.0 * normals(0, k).head<2>();
    ukf.correct(y, place);
    kalman.correct(y);
    ASSERT_LT((ukf.state() - kalman.x.head<4>()).norm(), 1e-8) << k;
    ASSERT_LT((ukf.covariance() - kalman.P.topLeftCorner<4, 4>()).norm(), 1e-8) << k;
  }
}

Consistency with_memory(bool knows, bool gaps = false) {
  const Vector4d start_sd(1.0, 1.0, 0.3, 0.3);
  const auto place = [](const Vector4d& x) -> Vector2d { return x.head<2>(); };
  Consistency sum;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const Vector4d start(0.0, 0.0, 1.0, -0.5);
    Vector4d truth = start + start_sd.cwiseProduct(normals(run, 0));
    Ukf<4, 2> ukf(remembering_settings(knows), start, start_sd.cwiseAbs2().asDiagonal());
    Remembering sensor;
    sensor.noise = sensor.sd.cwiseProduct(normals(run, 1).head<2>());
    double nis = 0.0;
    for (std::uint64_t k = 1; k <= cycles; ++k) {
      truth = glide(truth) + Vector4d(0.02, 0.02, 0.05, 0.05).cwiseProduct(normals(run, 2 * k));
      ukf.predict(glide, place);
      Vector2d y = truth.head<2>() + sensor.next(normals(run, 2 * k + 1).head<2>());
      if (gaps && (run + k) % 7 == 0) y(0) = std::numeric_limits<double>::quiet_NaN();
      const auto& update = ukf.correct(y, place);
      nis = update.nis / update.used;
    }
    Vector4d e = truth - ukf.state();
    ukf.root().triangularView<Eigen::Lower>().solveInPlace(e);
    sum.nees += e.squaredNorm();
    sum.nis += nis;
  }
  return sum;
}

TEST(UkfWithRememberingNoise, IsConsistentAndTooSureIfTheMemoryIsLeftOut) {
  const double knowing = with_memory(true).nees;
  EXPECT_GT(below(knowing, 4 * runs), 0.025) << knowing / runs;
  EXPECT_LT(below(knowing, 4 * runs), 0.975) << knowing / runs;
  EXPECT_GT(with_memory(false).nees / runs, 6.0);
}

TEST(UkfWithRememberingNoise, IsALittleTooSureWhereGapsMakeItStartAfresh) {
  const double with_gaps = with_memory(true, true).nees;
  EXPECT_GT(below(with_gaps, 4 * runs), 0.999);
  EXPECT_LT(with_gaps / runs, 5.2);
}

TEST(UkfWithRememberingNoise, RefusesCorrelationsThatAreNone) {
  UkfSettings<4, 2> settings = remembering_settings(true);
  settings.measurement_memory(1) = 1.0;
  EXPECT_THROW((Ukf<4, 2>(settings, Vector4d::Zero(), Matrix4d::Identity())), InputError);
}

}  // namespace
}  // namespace shoal::scenarios
