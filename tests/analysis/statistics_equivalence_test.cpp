#include "shoal/analysis/statistics/equivalence.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {
namespace {

const std::vector<double> six_differences{0.2, -0.5, 0.1, 0.7, -0.1, 0.4};

TEST(Equivalence, IsTheWorseOfTwoOneSidedTests) {
  std::vector<double> above = six_differences, below = six_differences;
  for (double& x : above) x += 0.6;
  for (double& x : below) x -= 0.6;
  EXPECT_NEAR(equivalence_p_value(six_differences, 0.6).value(),
              std::max(paired_t_test(above, Alternative::greater).value().p_value,
                       paired_t_test(below, Alternative::less).value().p_value),
              1e-14);
}

TEST(Equivalence, IsShownJustWhereTheIntervalLiesWithinTheMargin) {
  const Interval interval = t_interval(six_differences, 0.9).value();
  const double margin = std::max(-interval.low, interval.high);
  EXPECT_NEAR(equivalence_p_value(six_differences, margin).value(), 0.05, 1e-12);
  EXPECT_LT(equivalence_p_value(six_differences, margin + 1e-6).value(), 0.05);
  EXPECT_GT(equivalence_p_value(six_differences, margin - 1e-6).value(), 0.05);
}

TEST(Equivalence, IsMoreLikelyNotShownWhereTheMeanIsOutside) {
  EXPECT_GT(equivalence_p_value(std::vector{1.0, 1.2, 1.1}, 0.5).value(), 0.5);
}

TEST(Equivalence, IsTheSameForNegatedDifferences) {
  std::vector<double> negated;
  for (const double x : six_differences) negated.push_back(-x);
  EXPECT_EQ(equivalence_p_value(six_differences, 0.4), equivalence_p_value(negated, 0.4));
}

TEST(Equivalence, NeedsScatterAndAMargin) {
  EXPECT_FALSE(equivalence_p_value(std::vector{0.1}, 1.0));
  EXPECT_FALSE(equivalence_p_value(std::vector{0.1, 0.1}, 1.0));
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(equivalence_p_value(six_differences, bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace shoal::analysis::statistics
