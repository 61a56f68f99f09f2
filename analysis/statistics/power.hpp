#pragma once

#include <optional>

#include "shoal/analysis/statistics/paired_test.hpp"

namespace shoal::analysis::statistics {

// The chance that a test of n normal differences rejects. Their effect is their true mean in true
// standard deviations; it may be infinite, where they do not scatter.

/// Of a paired t test at level `alpha`, by the noncentral t distribution (Cohen 1988, ch. 2); the
/// true mean is `difference` and the standard deviation `sd` (in the same unit). A two-sided test
/// may also reject on the wrong side. Throws std::invalid_argument unless n >= 2, sd > 0, and alpha
/// lies between 0 and 1.
double paired_t_power(int n, double difference, double sd, double alpha,
                      Alternative alternative = Alternative::two_sided);

/// Of a two-sided test at level `alpha`. The t test's as above. That of the exact tests is the
/// share of 4000 simulated samples, always the same ones, as long as so few patterns of signs may
/// be further out (256 of the sign-flip test, 60 differences of Wilcoxon's) that no formula is
/// true; beyond, the t test's, with the effect times sqrt(3 / pi) for Wilcoxon's, as in large
/// samples (Lehmann 1975, sec. 4.2). Throws std::invalid_argument as above.
double two_sided_power(const PairedTest& test, int n, double effect, double alpha);

/// The fewest pairs, at least 2, with which a two-sided test has that power; nothing if `most`
/// pairs do not suffice. Throws std::invalid_argument as above, and unless the power lies between 0
/// and 1.
std::optional<int> replications_for(const PairedTest& test, double effect, double alpha,
                                    double power, int most = 10'000);
/// The same for the paired t test.
std::optional<int> replications_for(double difference, double sd, double alpha, double power,
                                    int most = 10'000);

}  // namespace shoal::analysis::statistics
