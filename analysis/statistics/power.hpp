#pragma once

#include <optional>

#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {

/// The chance that a paired t test of `n` differences rejects at level `alpha`, if their true mean
/// is `difference` and their standard deviation `sd` (in the same unit), by the noncentral t
/// distribution (Cohen 1988, ch. 2). A two-sided test may also reject on the wrong side. Throws
/// std::invalid_argument unless n >= 2, sd > 0 and alpha lies between 0 and 1.
double paired_t_power(int n, double difference, double sd, double alpha,
                      Alternative alternative = Alternative::two_sided);

/// The fewest pairs, at least 2, with which a two-sided paired t test has that power; nothing if
/// `most` pairs do not suffice. Throws std::invalid_argument as above, and unless the power lies
/// between 0 and 1.
std::optional<int> replications_for(double difference, double sd, double alpha, double power,
                                    int most = 10'000);

}  // namespace shoal::analysis::statistics
