#pragma once

#include "shoal/analysis/statistics/intervals.hpp"

namespace shoal::analysis::statistics {

// Of `count` among n independent trials, each with the same chance. All throw
// std::invalid_argument unless 0 <= count <= n and n >= 1.

/// The exact interval of that chance (Clopper and Pearson 1934); `level` is its least confidence.
Interval clopper_pearson(int count, int n, double level);

/// Of so many or more, if each has the chance p (0 to 1).
double chance_of_at_least(int count, int n, double p);

/// Of so many or fewer.
double chance_of_at_most(int count, int n, double p);

}  // namespace shoal::analysis::statistics
