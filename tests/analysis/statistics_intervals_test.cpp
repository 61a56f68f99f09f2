#include "shoal/analysis/statistics/intervals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/summary.hpp"
#include "tests/analysis/sleep_hours.hpp"

namespace shoal::analysis::statistics {
namespace {

/// Efron and Tibshirani 1993, table 14.1: spatial perception of 26 children, test A.
const std::vector<double> spatial{48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                  0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};

double plain_variance(Sample values) {
  const double centre = mean(values);
  double squares = 0.0;
  for (const double x : values) squares += (x - centre) * (x - centre);
  return squares / static_cast<double>(values.size());
}

double median(Sample values) {
  return quantile(values, 0.5);
}

/// The interval without any drawing: all n^n equally likely resamples, one after the other. Its
/// ends are the quantiles whose probabilities are `off` above those of BCa.
Interval exhaustive(Sample values, const Statistic& statistic, double level, double off = 0.0) {
  const std::size_t n = values.size();
  std::vector<double> replicates, resample(n);
  std::vector<std::size_t> digits(n);
  while (true) {
    std::ranges::transform(digits, resample.begin(), [&](std::size_t i) { return values[i]; });
    replicates.push_back(statistic(resample));
    const auto next = std::ranges::find_if(digits, [&](std::size_t d) { return d + 1 < n; });
    std::fill(digits.begin(), next, 0);
    if (next == digits.end()) break;
    ++*next;
  }
  const double own = statistic(values);
  double below = 0.0;
  for (const double x : replicates) below += x < own - 1e-9 ? 1.0 : x < own + 1e-9 ? 0.5 : 0.0;

  std::vector<double> influence;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> others(values.begin(), values.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    influence.push_back(-statistic(others));
  }
  double squares = 0.0, cubes = 0.0;
  for (const double x : influence) {
    squares += std::pow(x - mean(influence), 2);
    cubes += std::pow(x - mean(influence), 3);
  }
  const double a = cubes / (6.0 * std::pow(squares, 1.5));
  const boost::math::normal normal;
  const double z0 = boost::math::quantile(normal, below / static_cast<double>(replicates.size()));
  const auto end = [&](double p) {
    const double w = z0 + boost::math::quantile(normal, p);
    return quantile(replicates, cdf(normal, z0 + w / (1.0 - a * w)) + off);
  };
  return {end((1.0 - level) / 2.0), end((1.0 + level) / 2.0)};
}

TEST(TInterval, IsThatOfStudentsSleepers) {
  const Interval interval = t_interval(sleep_hours, 0.95).value();
  EXPECT_NEAR(interval.low, -2.4598858, 5e-8);
  EXPECT_NEAR(interval.high, -0.7001142, 5e-8);
}

TEST(Intervals, AreUndefinedForSamplesWithoutScatter) {
  for (const std::vector<double>& values :
       {std::vector<double>{}, {1.0}, {2.0, 2.0, 2.0}, {0.0, 0.0}}) {
    EXPECT_FALSE(t_interval(values, 0.95));
    EXPECT_FALSE(bca_interval_of_mean(values, 0.95));
    EXPECT_FALSE(bca_interval(values, median, 0.95));
  }
}

TEST(Intervals, RefuseWhatIsNoLevelNoNumberAndNoResample) {
  const std::vector<double> values{1.0, 2.0, 4.0};
  for (const double bad : {0.0, 1.0, -0.5, 95.0, std::nan("")}) {
    EXPECT_THROW(t_interval(values, bad), std::invalid_argument);
    EXPECT_THROW(bca_interval_of_mean(values, bad), std::invalid_argument);
  }
  const std::vector<double> infinite{1.0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(t_interval(infinite, 0.95), std::invalid_argument);
  EXPECT_THROW(bca_interval_of_mean(infinite, 0.95), std::invalid_argument);
  EXPECT_THROW(bca_interval_of_mean(values, 0.95, {.resamples = 0}), std::invalid_argument);
}

TEST(BcaInterval, IsThatOfEfronAndTibshiranisChildren) {
  // Table 14.2 has (115.8, 259.6) from 2000 resamples. The standard error of the variance is 42
  // there, so that the ends of theirs are uncertain by about 4 (intervals.hpp).
  const Interval interval =
      bca_interval(spatial, plain_variance, 0.9, {.resamples = 100'000}).value();
  EXPECT_NEAR(interval.low, 115.8, 4.0);
  EXPECT_NEAR(interval.high, 259.6, 4.0);
}

TEST(BcaInterval, IsThatOfAllResamplesWhereTheseAreFew) {
  const std::vector<double> skewed{0.31, 0.52, 0.97, 1.88, 3.61, 7.4};
  // Drawing 200 000 moves the probabilities of the ends by a standard error of up to 0.0012, and as
  // much twice over through z0: 4 of their sum in quadrature are 0.011.
  constexpr double off = 0.011, same = 1e-12;
  for (const double level : {0.5, 0.8, 0.9}) {
    const Interval drawn = bca_interval_of_mean(skewed, level, {.resamples = 200'000}).value();
    const Interval lower = exhaustive(skewed, mean, level, -off);
    const Interval upper = exhaustive(skewed, mean, level, off);
    EXPECT_GE(drawn.low, lower.low - same) << level;
    EXPECT_LE(drawn.low, upper.low + same) << level;
    EXPECT_GE(drawn.high, lower.high - same) << level;
    EXPECT_LE(drawn.high, upper.high + same) << level;
  }
}

TEST(BcaInterval, CountsHalfOfTheResamplesWithTheSameStatistic) {
  // 12 % of the resamples of these have their mean, and as many of them lie below as above: there
  // is no bias to correct, and the interval is symmetric as they are.
  const std::vector<double> even{0.1, 0.2, 0.3, 0.4, 0.5};
  const Interval all = exhaustive(even, mean, 0.8);
  const Interval drawn = bca_interval_of_mean(even, 0.8, {.resamples = 200'000}).value();
  EXPECT_NEAR(all.low + all.high, 0.6, 1e-12);
  EXPECT_NEAR(drawn.low, all.low, 1e-12);
  EXPECT_NEAR(drawn.high, all.high, 1e-12);
}

TEST(BcaInterval, OfTheMeanIsThatOfTheStatisticCalledMean) {
  const Interval fast = bca_interval_of_mean(sleep_hours, 0.95).value();
  const Interval slow = bca_interval(sleep_hours, mean, 0.95).value();
  EXPECT_EQ(fast.low, slow.low);
  EXPECT_EQ(fast.high, slow.high);
}

TEST(BcaInterval, ChangesWithTheSeedAndWithNothingElse) {
  const Interval once = bca_interval_of_mean(sleep_hours, 0.95, {.seed = 3}).value();
  const Interval again = bca_interval_of_mean(sleep_hours, 0.95, {.seed = 3}).value();
  const Interval other = bca_interval_of_mean(sleep_hours, 0.95, {.seed = 4}).value();
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
  EXPECT_TRUE(once.low != other.low || once.high != other.high);
}

TEST(BcaInterval, IsUndefinedWhereTheStatisticSaysNothing) {
  const std::vector<double> values{1.0, 2.0, 4.0, 8.0};
  EXPECT_FALSE(bca_interval(
      values, [](Sample) { return 5.0; }, 0.95));
  const auto greatest = [](Sample s) { return *std::ranges::max_element(s); };
  EXPECT_TRUE(bca_interval(values, greatest, 0.5));  // at the edge, and still a statistic
  // No value where all values of a resample are the same.
  const auto precision = [](Sample s) { return 1.0 / plain_variance(s); };
  EXPECT_FALSE(bca_interval(values, precision, 0.95));
  // Larger of the sample than of any resample: that bias has no bound.
  const auto mostly_distinct = [](Sample s) {
    const std::set<double> distinct(s.begin(), s.end());
    return 100.0 * static_cast<double>(distinct.size()) + mean(s);
  };
  const std::vector<double> many{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18};
  EXPECT_FALSE(bca_interval(many, mostly_distinct, 0.95));
}

/// Between 3 and 12 different numbers with two decimals.
std::vector<double> some_values() {
  const auto whole =
      *rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(-10'000, 10'000)),
                         [](const std::vector<int>& v) {
                           return v.size() >= 3 && v.size() <= 12 &&
                                  std::ranges::adjacent_find(v, std::not_equal_to{}) != v.end();
                         });
  std::vector<double> values;
  for (const int x : whole) values.push_back(x / 100.0);
  return values;
}

TEST(Intervals, MoveTurnAndStretchWithTheirSample) {
  EXPECT_TRUE(rc::check("equivariance", [] {
    const std::vector<double> values = some_values();
    const double scale = *rc::gen::element(-2.0, -0.3, 0.01, 7.0);
    const double shift = *rc::gen::element(-50.0, 0.0, 3.3);
    std::vector<double> moved;
    for (const double x : values) moved.push_back(scale * x + shift);

    const auto compare = [&](const std::optional<Interval>& a, const std::optional<Interval>& b) {
      RC_ASSERT(a.has_value() == b.has_value());
      if (!a) return;
      double low = scale * a->low + shift, high = scale * a->high + shift;
      if (scale < 0.0) std::swap(low, high);
      RC_ASSERT(std::abs(b->low - low) < 1e-9);
      RC_ASSERT(std::abs(b->high - high) < 1e-9);
      RC_ASSERT(b->low <= b->high);
    };
    const BootstrapOptions few{.resamples = 500};
    compare(t_interval(values, 0.9), t_interval(moved, 0.9));
    compare(bca_interval_of_mean(values, 0.9, few), bca_interval_of_mean(moved, 0.9, few));
  }));
}

TEST(Intervals, WidenWithTheirLevel) {
  EXPECT_TRUE(rc::check("nesting", [] {
    const std::vector<double> values = some_values();
    const BootstrapOptions few{.resamples = 500};
    const auto nested = [](const std::optional<Interval>& in, const std::optional<Interval>& out) {
      RC_ASSERT(!in || !out || (out->low <= in->low && in->high <= out->high));
    };
    nested(t_interval(values, 0.5), t_interval(values, 0.95));
    nested(bca_interval_of_mean(values, 0.5, few), bca_interval_of_mean(values, 0.95, few));
  }));
}

}  // namespace
}  // namespace shoal::analysis::statistics
