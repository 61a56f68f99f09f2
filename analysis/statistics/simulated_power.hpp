#pragma once

#include <functional>
#include <vector>

namespace shoal::analysis::statistics {

/// Beyond that many, formulas for large samples do as well.
inline constexpr int most_simulated_differences = 60;

/// Whether a two-sided test rejects a sample.
using Rejects = std::function<bool(std::vector<double> differences)>;

/// The share of 4000 samples of n normal differences, always the same ones, that are rejected;
/// `effect` is their true mean in standard deviations. At most most_simulated_differences.
double simulated_power(int n, double effect, const Rejects& rejects);

}  // namespace shoal::analysis::statistics
