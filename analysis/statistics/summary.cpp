#include "shoal/analysis/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace shoal::analysis::statistics {

Summary summarise(Sample values) {
  return {.n = static_cast<int>(values.size()),
          .mean = mean(values),
          .sd = standard_deviation(values),
          .median = quantile(values, 0.5),
          .q1 = quantile(values, 0.25),
          .q3 = quantile(values, 0.75),
          .least = quantile(values, 0.0),
          .greatest = quantile(values, 1.0)};
}

double quantile(Sample values, double p) {
  require_finite(values);
  if (!(p >= 0.0 && p <= 1.0)) throw std::invalid_argument("a quantile's p is outside [0, 1]");
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();

  const double place = p * static_cast<double>(values.size() - 1);
  const double whole = std::floor(place);
  std::vector<double> ordered(values.begin(), values.end());
  const auto below = ordered.begin() + static_cast<std::ptrdiff_t>(whole);
  std::ranges::nth_element(ordered, below);
  if (place == whole) return *below;
  return std::lerp(*below, *std::min_element(below + 1, ordered.end()), place - whole);
}

}  // namespace shoal::analysis::statistics
