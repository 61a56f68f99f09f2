// Whether the filter's covariance is that of its errors: NEES and NIS over many runs.

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>

#include "shoal/core/random.hpp"
#include "shoal/scenarios/estimators/ukf.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr int runs = 4000;
constexpr int steps = 40;

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

/// The filter is told of `assumed` times the variance that the process noise has.
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
    for (std::uint64_t k = 1; k <= steps; ++k) {
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

}  // namespace
}  // namespace shoal::scenarios
