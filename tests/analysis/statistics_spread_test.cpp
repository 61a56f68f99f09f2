#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <vector>

#include "shoal/analysis/statistics/paired_spread.hpp"
#include "shoal/analysis/statistics/proportion.hpp"
#include "shoal/analysis/statistics/variation.hpp"

namespace shoal::analysis::statistics {
namespace {

TEST(Proportion, HasTheIntervalOfClopperAndPearson) {
  const Interval one = clopper_pearson(1, 5, 0.95);
  EXPECT_NEAR(one.low, 0.00505076, 1e-8);
  EXPECT_NEAR(one.high, 0.71641794, 1e-8);
  const Interval none = clopper_pearson(0, 10, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(clopper_pearson(3, 3, 0.95).high, 1.0);
}

TEST(Proportion, HasTheBinomialChances) {
  EXPECT_NEAR(chance_of_at_least(2, 3, 0.5), 0.5, 1e-15);
  EXPECT_NEAR(chance_of_at_most(1, 4, 0.25), std::pow(0.75, 4) + std::pow(0.75, 3), 1e-15);
  EXPECT_EQ(chance_of_at_least(0, 4, 0.1), 1.0);
  // An end of the interval is the chance that the test of that level just rejects.
  const Interval interval = clopper_pearson(7, 20, 0.95);
  EXPECT_NEAR(chance_of_at_least(7, 20, interval.low), 0.025, 1e-10);
  EXPECT_NEAR(chance_of_at_most(7, 20, interval.high), 0.025, 1e-10);
  EXPECT_THROW(chance_of_at_least(5, 4, 0.5), std::invalid_argument);
  EXPECT_THROW(clopper_pearson(0, 0, 0.95), std::invalid_argument);
}

const std::vector<double> ours{10.2, 9.1, 11.4, 10.0, 12.3, 8.7, 10.9, 9.6},
    theirs{11.0, 7.5, 13.9, 9.2, 15.1, 7.7, 12.0, 8.1};

/// The t statistic of the slope of sums on differences, by least squares.
double t_of_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, sxx = 0.0, sxy = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += (x[k] - y[k]) / n, my += (x[k] + y[k]) / n;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double d = x[k] - y[k] - mx, s = x[k] + y[k] - my;
    sxx += d * d;
    sxy += d * s;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double d = x[k] - y[k] - mx, s = x[k] + y[k] - my;
    rest += std::pow(s - sxy / sxx * d, 2);
  }
  return sxy / sxx / std::sqrt(rest / (n - 2.0) / sxx);
}

TEST(PairedSpread, IsTheTestOfTheSlopeOfSumsOnDifferences) {
  const auto result = spread_test(ours, theirs);
  ASSERT_TRUE(result);
  const double t = t_of_slope(ours, theirs);
  EXPECT_NEAR(result->statistic, t, 1e-9);
  const boost::math::students_t null(6);
  EXPECT_NEAR(result->p_value, 2.0 * cdf(null, -std::abs(t)), 1e-12);
  EXPECT_NEAR(spread_test(ours, theirs, Alternative::less)->p_value, cdf(null, t), 1e-12);
  EXPECT_LT(result->statistic, 0.0) << "ours scatter less";
}

TEST(PairedSpread, HasAnIntervalOfTheRatiosThatAreNotRejected) {
  const auto interval = spread_ratio_interval(ours, theirs, 0.95);
  ASSERT_TRUE(interval);
  EXPECT_LT(interval->low, *spread_ratio(ours, theirs));
  EXPECT_GT(interval->high, *spread_ratio(ours, theirs));
  for (const double ratio : {interval->low, interval->high}) {
    std::vector<double> scaled = theirs;
    for (double& x : scaled) x *= ratio;
    EXPECT_NEAR(spread_test(ours, scaled)->p_value, 0.05, 1e-9);
  }
}

TEST(PairedSpread, NeedsThreePairsThatVary) {
  const std::vector<double> constant(8, 1.0), two{1.0, 2.0};
  EXPECT_FALSE(spread_test(ours, constant));
  EXPECT_FALSE(spread_ratio(constant, theirs));
  EXPECT_FALSE(spread_test(two, two));
  EXPECT_THROW(spread_test(ours, two), std::invalid_argument);
  // The same numbers twice: as much scatter, and no doubt of it.
  EXPECT_EQ(spread_test(ours, ours)->p_value, 1.0);
}

TEST(Variation, IsTestedByTheNoncentralT) {
  EXPECT_NEAR(*variation(ours), standard_deviation(ours) / mean(ours), 1e-15);
  const auto far = variation_test(ours, 1e9);
  const double t = mean(ours) / *standard_error(ours);
  EXPECT_NEAR(far->below, cdf(complement(boost::math::students_t(7), t)), 1e-12);
  const auto close = variation_test(ours, 0.12);
  EXPECT_NEAR(close->below + close->above, 1.0, 1e-9);
  EXPECT_LT(variation_test(ours, 0.5)->below, 0.001);
  EXPECT_LT(variation_test(ours, 0.02)->above, 0.001);
}

TEST(Variation, HasAnIntervalOfWhatIsNotRejected) {
  const auto interval = variation_interval(ours, 0.95);
  EXPECT_NEAR(variation_test(ours, interval->low)->above, 0.025, 1e-6);
  EXPECT_NEAR(variation_test(ours, interval->high)->below, 0.025, 1e-6);
  const std::vector<double> about_zero{-1.0, 2.0, -2.0, 1.5};
  EXPECT_TRUE(std::isinf(variation_interval(about_zero, 0.95)->high));
  EXPECT_FALSE(variation(std::vector<double>(4, 2.0)));
}

}  // namespace
}  // namespace shoal::analysis::statistics
