#pragma once

#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {

// The standard deviations of two conditions under the same seeds, whose numbers are pairs of a
// bivariate normal distribution. All throw std::invalid_argument if the samples differ in size;
// nothing where one of them does not vary (sample.hpp).

/// Ours in theirs.
std::optional<double> spread_ratio(Sample ours, Sample theirs);

/// Whether ours differs from theirs, is greater, or less (Pitman 1939; Morgan 1939): sums and
/// differences of pairs are uncorrelated just if it does not. The statistic is t, with n - 2
/// degrees of freedom. Nothing for n < 3.
std::optional<TestResult> spread_test(Sample ours, Sample theirs,
                                      Alternative alternative = Alternative::two_sided);

/// Of the ratio: those that the test does not reject. Nothing for n < 3.
std::optional<Interval> spread_ratio_interval(Sample ours, Sample theirs, double level);

}  // namespace shoal::analysis::statistics
