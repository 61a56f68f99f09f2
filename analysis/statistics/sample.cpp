#include "shoal/analysis/statistics/sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace shoal::analysis::statistics {
namespace {

double count(Sample values) {
  return static_cast<double>(values.size());
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void require_finite(Sample values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw std::invalid_argument("value " + std::to_string(i) + " of a sample is not finite");
    }
  }
}

double mean(Sample values) {
  require_finite(values);
  if (values.empty()) return none;
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  if (std::isfinite(sum)) return sum / count(values);
  return std::accumulate(values.begin(), values.end(), 0.0,
                         [&](double part, double x) { return part + x / count(values); });
}

double standard_deviation(Sample values) {
  const double centre = mean(values);
  if (values.size() < 2) return none;
  double squares = 0.0;
  for (const double x : values) squares += (x - centre) * (x - centre);
  if (std::isfinite(squares) && squares >= std::numeric_limits<double>::min()) {
    return std::sqrt(squares / (count(values) - 1.0));
  }
  // Squares of the least and the greatest doubles are none.
  double furthest = 0.0;
  for (const double x : values) furthest = std::max(furthest, std::abs(x / 2.0 - centre / 2.0));
  if (furthest == 0.0) return 0.0;
  squares = 0.0;
  for (const double x : values) squares += std::pow((x / 2.0 - centre / 2.0) / furthest, 2);
  return 2.0 * furthest * std::sqrt(squares / (count(values) - 1.0));
}

std::optional<double> standard_error(Sample values) {
  const double rounding = 10.0 * std::numeric_limits<double>::epsilon() * std::abs(mean(values));
  if (values.size() < 2) return std::nullopt;
  const double error = standard_deviation(values) / std::sqrt(count(values));
  return error > rounding ? std::optional(error) : std::nullopt;
}

}  // namespace shoal::analysis::statistics
