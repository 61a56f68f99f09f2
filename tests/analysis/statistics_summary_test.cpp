#include "shoal/analysis/statistics/summary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace shoal::analysis::statistics {
namespace {

TEST(Summary, IsWhatIsComputedByHand) {
  const Summary s = summarise(std::vector{4.0, 1.0, 10.0, 3.0, 2.0});
  EXPECT_EQ(s.n, 5);
  EXPECT_DOUBLE_EQ(s.mean, 4.0);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt((0.0 + 9.0 + 36.0 + 1.0 + 4.0) / 4.0));
  EXPECT_EQ(s.median, 3.0);
  EXPECT_EQ(s.q1, 2.0);
  EXPECT_EQ(s.q3, 4.0);
  EXPECT_EQ(s.least, 1.0);
  EXPECT_EQ(s.greatest, 10.0);
}

TEST(Summary, OfNothingIsNotANumber) {
  const Summary s = summarise({});
  EXPECT_EQ(s.n, 0);
  for (const double x : {s.mean, s.sd, s.median, s.q1, s.q3, s.least, s.greatest}) {
    EXPECT_TRUE(std::isnan(x));
  }
}

TEST(Summary, OfOneValueHasNoStandardDeviation) {
  const Summary s = summarise(std::vector{7.0});
  EXPECT_EQ(s.n, 1);
  EXPECT_TRUE(std::isnan(s.sd));
  for (const double x : {s.mean, s.median, s.q1, s.q3, s.least, s.greatest}) EXPECT_EQ(x, 7.0);
}

TEST(Summary, RefusesValuesThatAreNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(summarise(std::vector{1.0, bad}), std::invalid_argument);
    EXPECT_THROW(quantile(std::vector{bad}, 0.5), std::invalid_argument);
    EXPECT_THROW(mean(std::vector{bad}), std::invalid_argument);
    EXPECT_THROW(standard_deviation(std::vector{bad}), std::invalid_argument);
    EXPECT_THROW(standard_error(std::vector{bad}), std::invalid_argument);
  }
}

TEST(Quantile, IsLinearBetweenTheOrderStatistics) {
  const std::vector<double> values{30.0, 10.0, 20.0, 50.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 17.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 44.0);
}

TEST(Quantile, RefusesAProbabilityThatIsNone) {
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(quantile(std::vector{1.0}, bad), std::invalid_argument);
  }
}

TEST(Quantile, RisesWithItsProbability) {
  EXPECT_TRUE(rc::check("monotonic", [](const std::vector<int>& whole) {
    const std::vector<double> values(whole.begin(), whole.end());
    RC_PRE(!values.empty());
    double before = -std::numeric_limits<double>::infinity();
    for (int percent = 0; percent <= 100; ++percent) {
      const double now = quantile(values, percent / 100.0);
      RC_ASSERT(now >= before);
      before = now;
    }
  }));
}

TEST(StandardError, IsNothingWithoutScatter) {
  EXPECT_FALSE(standard_error({}));
  EXPECT_FALSE(standard_error(std::vector{3.0}));
  EXPECT_FALSE(standard_error(std::vector{3.0, 3.0, 3.0}));
  EXPECT_FALSE(standard_error(std::vector{0.0, 0.0}));
  // Mathematically equal, and not the same doubles.
  ASSERT_NE(0.3 - 0.2, 0.2 - 0.1);
  EXPECT_FALSE(standard_error(std::vector{0.3 - 0.2, 0.2 - 0.1}));
  EXPECT_DOUBLE_EQ(standard_error(std::vector{1.0, 3.0}).value(), 1.0);
}

}  // namespace
}  // namespace shoal::analysis::statistics
