#include "shoal/analysis/statistics/differences.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace shoal::analysis::statistics {
namespace {

double rounding_of(double greatest) {
  return 8.0 * std::numeric_limits<double>::epsilon() * greatest;
}

double greatest_magnitude(Sample values) {
  double greatest = 0.0;
  for (const double x : values) greatest = std::max(greatest, std::abs(x));
  return greatest;
}

}  // namespace

Differences::Differences(std::vector<double> values) : values_(std::move(values)) {
  require_finite(values_);
  rounding_ = rounding_of(greatest_magnitude(values_));
}

Differences::Differences(Sample values)
    : Differences(std::vector<double>(values.begin(), values.end())) {}

Differences Differences::between(Sample ours, Sample theirs) {
  if (ours.size() != theirs.size()) throw std::invalid_argument("pairs need two values each");
  require_finite(ours);
  require_finite(theirs);
  std::vector<double> values(ours.begin(), ours.end());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= theirs[k];
  Differences differences(std::move(values));
  differences.rounding_ =
      rounding_of(std::max(greatest_magnitude(ours), greatest_magnitude(theirs)));
  return differences;
}

bool Differences::is_zero(double difference) const {
  return std::abs(difference) <= rounding_;
}

bool Differences::all_zero() const {
  return std::ranges::all_of(values_, [this](double x) { return is_zero(x); });
}

std::optional<double> Differences::standard_error() const {
  const std::optional<double> error = statistics::standard_error(values_);
  const bool scatters = error && standard_deviation(values_) > rounding_;
  return scatters ? error : std::nullopt;
}

}  // namespace shoal::analysis::statistics
