#pragma once

#include <cstdint>
#include <optional>

#include "shoal/analysis/statistics/differences.hpp"

namespace shoal::analysis::statistics {

// Tests of paired differences: of two conditions under the same seeds, seed by seed. The null
// hypothesis is that a difference is as likely as its negative (for t: that the mean is 0).

/// What speaks against the null hypothesis: differences far from 0, above it, or below it.
enum class Alternative { two_sided, greater, less };

struct TestResult {
  double statistic = 0.0;
  double p_value = 1.0;
  int n = 0;          ///< differences that the test used
  bool exact = true;  ///< p from the statistic's own distribution, neither sampled nor approximated
};

struct SignFlipOptions {
  int resamples = 99'999;  ///< at least 1; only for samples too large for all sign patterns
  std::uint64_t seed = 1;
};

/// Fisher's randomisation test of the mean (The design of experiments 1935, sec. 21): the share of
/// all 2^n patterns of signs that give a mean as far out as the observed one. Means that differ by
/// rounding only (differences.hpp) are equal.
///
/// Exact up to n = 32; beyond, `resamples` random patterns, b of them as far out, and the p-value
/// (b + 1) / (resamples + 1), which never understates the level (Phipson and Smyth 2010). The
/// statistic is the mean. Nothing for n = 0.
std::optional<TestResult> sign_flip_test(const Differences& differences,
                                         Alternative alternative = Alternative::two_sided,
                                         const SignFlipOptions& options = {});

/// The least two-sided p-value of that test, by default, of `n` differences: of all patterns of
/// signs, that of the sample and its opposite count.
double least_sign_flip_p_value(int n);

/// Wilcoxon's signed-rank test. Differences of 0 are left out, as Wilcoxon 1945 did (not ranked, as
/// Pratt 1959 does), equal ones share their midrank; both up to rounding (differences.hpp).
///
/// Exact up to n = 100, also with ties; beyond, normal with a correction for ties and for
/// continuity (Hollander and Wolfe 1999, sec. 3.1). The statistic is the sum of the ranks of
/// positive differences. Nothing if there is no difference but 0.
std::optional<TestResult> signed_rank_test(const Differences& differences,
                                           Alternative alternative = Alternative::two_sided);

/// Student's t test; exact for normal differences. The statistic is t, with n - 1 degrees of
/// freedom. Nothing where there is no standard error (sample.hpp).
std::optional<TestResult> paired_t_test(const Differences& differences,
                                        Alternative alternative = Alternative::two_sided);

}  // namespace shoal::analysis::statistics
