#pragma once

#include <span>
#include <vector>

namespace shoal::analysis::statistics {

/// Holm's adjusted p-values (1979), in the order given: to reject those that are at most alpha
/// keeps the chance of any false rejection among all at most alpha, however they depend on one
/// another. Throws std::invalid_argument for a p-value outside [0, 1] or NaN.
std::vector<double> holm(std::span<const double> p_values);

}  // namespace shoal::analysis::statistics
