#pragma once

#include <optional>

#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis::statistics {

/// The share of 4000 samples of n normal differences, always the same ones, in which a two-sided
/// exact test rejects at level `alpha`; `effect` is their true mean in standard deviations. Nothing
/// where formulas for large samples do as well (power.hpp), and for the t test.
std::optional<double> simulated_power(PairedTest test, int n, double effect, double alpha);

}  // namespace shoal::analysis::statistics
