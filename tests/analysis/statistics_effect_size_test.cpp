#include "shoal/analysis/statistics/effect_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/paired_tests.hpp"
#include "tests/analysis/sleep_hours.hpp"

namespace shoal::analysis::statistics {
namespace {

TEST(CohensDz, IsTOverTheRootOfN) {
  EXPECT_DOUBLE_EQ(cohens_d_z(sleep_hours).value(),
                   paired_t_test(sleep_hours).value().statistic / std::sqrt(10.0));
}

TEST(HedgesGz, MultipliesByTheFactorOfItsDegreesOfFreedom) {
  // By hand for two degrees of freedom: gamma(1) / (sqrt(1) gamma(1/2)) = 1 / sqrt(pi), and for
  // four: gamma(2) / (sqrt(2) gamma(3/2)) = sqrt(2 / pi).
  const std::vector<double> three{1.0, 2.0, 3.0}, five{1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_NEAR(hedges_g_z(three).value(), 2.0 * std::numbers::inv_sqrtpi, 1e-14);
  EXPECT_NEAR(hedges_g_z(five).value(),
              3.0 / std::sqrt(2.5) * std::numbers::sqrt2 * std::numbers::inv_sqrtpi, 1e-14);
  // Hedges and Olkin 1985, table 2.
  EXPECT_NEAR(hedges_g_z(sleep_hours).value() / cohens_d_z(sleep_hours).value(), 0.9139, 5e-5);
}

TEST(HedgesGz, IsUnbiasedForNormalDifferences) {
  std::mt19937 random(1);
  std::normal_distribution<double> difference(0.8, 1.0);
  constexpr int repetitions = 20'000;
  double g = 0.0, squares = 0.0, d = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<double> sample(6);
    for (double& x : sample) x = difference(random);
    const double now = hedges_g_z(sample).value();
    g += now / repetitions;
    squares += now * now / repetitions;
    d += cohens_d_z(sample).value() / repetitions;
  }
  const double error = std::sqrt((squares - g * g) / repetitions);
  EXPECT_NEAR(g, 0.8, 4.0 * error);
  EXPECT_GT(d, 0.8 + 4.0 * error);  // what the factor is for
}

TEST(RankBiserialCorrelation, IsTheBalanceOfTheSignedRanks) {
  // Ranks 1 to 4, of which 3 is negative: (7 - 3) / 10.
  EXPECT_DOUBLE_EQ(rank_biserial_correlation(std::vector{1.0, 2.0, -3.0, 4.0, 0.0}).value(), 0.4);
  EXPECT_EQ(rank_biserial_correlation(std::vector{1.0, 2.0}).value(), 1.0);
  EXPECT_EQ(rank_biserial_correlation(std::vector{-1.0, -2.0}).value(), -1.0);
  EXPECT_EQ(rank_biserial_correlation(std::vector{-1.0, 1.0}).value(), 0.0);
}

TEST(EffectSizes, AreUndefinedWhereThereIsNothingToMeasure) {
  EXPECT_FALSE(cohens_d_z(std::vector{1.0}));
  EXPECT_FALSE(cohens_d_z(std::vector{1.0, 1.0}));
  EXPECT_FALSE(hedges_g_z(std::vector{1.0, 2.0}));
  EXPECT_FALSE(hedges_g_z(std::vector{1.0, 1.0, 1.0}));
  EXPECT_FALSE(rank_biserial_correlation({}));
  EXPECT_FALSE(rank_biserial_correlation(std::vector{0.0}));
  EXPECT_THROW(cohens_d_z(std::vector{std::nan("")}), std::invalid_argument);
  EXPECT_THROW(rank_biserial_correlation(std::vector{std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::analysis::statistics
