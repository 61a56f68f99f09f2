#include "shoal/analysis/statistics/shape.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shoal/analysis/statistics/sample.hpp"

namespace shoal::analysis::statistics {
namespace {

TEST(Dip, OfEvenlySpacedValuesIsTheLeast) {
  EXPECT_NEAR(*dip(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}), 0.1, 1e-15);
  EXPECT_NEAR(*dip(std::vector{7.0}), 0.5, 1e-15);
}

TEST(Dip, OfTwoClustersIsNearlyAQuarter) {
  // Half of the values far from the other half: no single mode comes nearer than 1/4 to both, but
  // for the widths of the clusters.
  std::vector<double> values;
  for (int i = 0; i < 20; ++i) values.push_back(i * 1e-3 + (i < 10 ? 0.0 : 100.0));
  EXPECT_NEAR(*dip(values), 0.25, 0.03);
  EXPECT_LE(*dip_p_value(values), 0.001);
}

TEST(Dip, DoesNotChangeWithPlaceScaleDirectionAndOrder) {
  EXPECT_TRUE(rc::check("invariance", [] {
    std::mt19937 random(static_cast<unsigned>(*rc::gen::inRange(0, 1'000'000)));
    std::vector<double> values(static_cast<std::size_t>(*rc::gen::inRange(1, 30)));
    for (double& x : values) x = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    const double before = *dip(values);
    std::vector<double> other = values;
    for (double& x : other) x = 3.0 - 5.0 * x;
    std::ranges::shuffle(other, random);
    RC_ASSERT(std::abs(*dip(other) - before) < 1e-9);
  }));
}

TEST(Dip, IsNotDefinedWithTies) {
  EXPECT_FALSE(dip(std::vector{1.0, 1.0, 2.0, 3.0}));
  EXPECT_FALSE(dip({}));
  EXPECT_FALSE(dip_p_value(std::vector{1.0, 2.0, 3.0}));
}

TEST(Skewness, IsTheThirdStandardisedMoment) {
  EXPECT_NEAR(*skewness(std::vector{-1.0, 0.0, 1.0}), 0.0, 1e-15);
  // One of five at 1, the others at 0: (1 - 2p) / sqrt(p (1 - p)) with p = 0.2.
  EXPECT_NEAR(*skewness(std::vector{0.0, 0.0, 1.0, 0.0, 0.0}), 1.5, 1e-12);
  EXPECT_FALSE(skewness(std::vector{1.0, 1.0, 1.0}));
  EXPECT_NEAR(*skewness_p_value(std::vector{-1.0, 0.0, 1.0}), 1.0, 1e-12);
}

TEST(Chances, OfNormalAndUniformSamplesAreTheirLevel) {
  std::mt19937 random(3);
  int dips = 0, skewed = 0;
  constexpr int repetitions = 2000;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<double> uniform(20), normal(20);
    for (double& x : uniform) x = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    for (double& x : normal) x = std::normal_distribution<double>(0.0, 1.0)(random);
    dips += *dip_p_value(uniform) <= 0.05 ? 1 : 0;
    skewed += *skewness_p_value(normal) <= 0.05 ? 1 : 0;
  }
  // Binomial, twice: of these samples and of the 1999 behind the chances.
  const double error = std::sqrt(2.0 * 0.05 * 0.95 / repetitions);
  EXPECT_NEAR(dips / static_cast<double>(repetitions), 0.05, 4.0 * error);
  EXPECT_NEAR(skewed / static_cast<double>(repetitions), 0.05, 4.0 * error);
}

TEST(TwoGroups, OfSharesAreExactlyZeroAndOne) {
  std::vector<double> shares(96, 1.0);
  std::fill_n(shares.begin(), 8, 0.0);
  const auto groups = two_groups(shares);
  EXPECT_EQ(groups->low_mean, 0.0);
  EXPECT_EQ(groups->high_mean, 1.0);
}

TEST(TwoGroups, AreTheBestSplit) {
  const auto groups = two_groups(std::vector{121.0, 42.0, 41.0, 43.0, 122.0, 42.0});
  ASSERT_TRUE(groups);
  EXPECT_EQ(groups->low_n, 4);
  EXPECT_EQ(groups->high_n, 2);
  EXPECT_NEAR(groups->low_mean, 42.0, 1e-12);
  EXPECT_NEAR(groups->high_mean, 121.5, 1e-12);
  EXPECT_GT(groups->explained, 0.99);
  EXPECT_FALSE(two_groups(std::vector{1.0, 1.0}));
}

}  // namespace
}  // namespace shoal::analysis::statistics
