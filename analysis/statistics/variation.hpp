#pragma once

#include "shoal/analysis/statistics/intervals.hpp"

namespace shoal::analysis::statistics {

// The coefficient of variation of normal numbers: their standard deviation over the size of their
// mean. sqrt(n) mean / sd follows the noncentral t distribution with noncentrality sqrt(n) / cv
// (Johnson and Welch 1940). Nothing where there is no standard error (sample.hpp) and for a mean
// of 0.

/// The sample's.
std::optional<double> variation(Sample values);

struct VariationTest {
  double below = 1.0, above = 1.0;  ///< one-sided p-values: that it is below, or above, `bound`
};
/// Throws std::invalid_argument unless the bound is above 0.
std::optional<VariationTest> variation_test(Sample values, double bound);

/// Those that the test does not reject. Its upper end is infinite where the mean does not differ
/// from 0 at that level.
std::optional<Interval> variation_interval(Sample values, double level);

}  // namespace shoal::analysis::statistics
