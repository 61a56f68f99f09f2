#include "shoal/analysis/experiments/statistic.hpp"

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/intervals.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {

Estimate mean_of(const std::vector<double>& values) {
  const statistics::Summary summary = statistics::summarise(values);
  const std::optional<double> error = statistics::standard_error(values);
  // Without a scatter there is no uncertainty to take the digits from.
  return {.value = summary.mean,
          .digits = error ? decimals_for(*error) : Digits::significant(4),
          .n = summary.n,
          .each = values};
}

Estimate mean_with_interval(const std::vector<double>& values) {
  Estimate cell = mean_of(values);
  if (const auto interval = statistics::t_interval(values, confidence)) {
    const double half = (interval->high - interval->low) / 2.0;
    cell.uncertainty = PlusMinus{half};
    cell.digits = decimals_for(half);
  }
  return cell;
}

}  // namespace shoal::analysis
