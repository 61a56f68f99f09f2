#include "shoal/analysis/statistics/holm.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace shoal::analysis::statistics {

std::vector<double> holm(std::span<const double> p_values) {
  const auto is_probability = [](double p) { return p >= 0.0 && p <= 1.0; };
  if (!std::ranges::all_of(p_values, is_probability)) {
    throw std::invalid_argument("a p-value is outside [0, 1]");
  }
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });

  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;  // no hypothesis is rejected before one with a smaller p-value
  std::size_t left = p_values.size();
  for (const std::size_t i : order) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(left--) * p_values[i]));
    adjusted[i] = largest;
  }
  return adjusted;
}

}  // namespace shoal::analysis::statistics
