#include "shoal/analysis/experiments/measures/circular_spread.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace shoal::analysis {

std::optional<double> circular_spread(std::span<const double> angles, int order) {
  if (angles.size() < 2) return std::nullopt;
  std::complex<double> sum = 0.0;
  for (const double angle : angles) sum += std::polar(1.0, order * angle);
  const double resultant = std::min(1.0, std::abs(sum) / static_cast<double>(angles.size()));
  if (resultant <= 0.0) return std::nullopt;
  // Of the angles times `order`, and then on their own scale again.
  return std::sqrt(-2.0 * std::log(resultant)) / order;
}

}  // namespace shoal::analysis
