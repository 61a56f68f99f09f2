#include "shoal/analysis/experiments/results/contrast.hpp"

#include <algorithm>

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/analysis/statistics/proportion.hpp"
#include "shoal/analysis/statistics/summary.hpp"

namespace shoal::analysis {
namespace {

namespace stats = statistics;
using stats::Alternative;

OneSided sign_test(std::span<const double> numbers) {
  const auto n = static_cast<int>(numbers.size());
  const auto positive =
      static_cast<int>(std::ranges::count_if(numbers, [](double x) { return x > 0.0; }));
  const auto negative =
      static_cast<int>(std::ranges::count_if(numbers, [](double x) { return x < 0.0; }));
  return {stats::chance_of_at_least(positive, n, 0.5), stats::chance_of_at_least(negative, n, 0.5)};
}

/// Between the k-th least and the k-th greatest, with the largest k that keeps the level.
std::optional<stats::Interval> median_interval(std::span<const double> numbers) {
  std::vector<double> sorted(numbers.begin(), numbers.end());
  std::ranges::sort(sorted);
  const auto n = static_cast<int>(sorted.size());
  int k = 0;
  while (2 * (k + 1) <= n && 2.0 * stats::chance_of_at_least(n - k, n, 0.5) <= significance) ++k;
  if (k == 0) return std::nullopt;
  return stats::Interval{sorted[static_cast<std::size_t>(k - 1)],
                         sorted[static_cast<std::size_t>(n - k)]};
}

}  // namespace

std::optional<OneSided> one_sided(std::span<const double> numbers, Average average) {
  if (std::ranges::all_of(numbers, [](double x) { return x == 0.0; })) return std::nullopt;
  if (average == Average::median) return sign_test(numbers);
  const auto above = stats::paired_t_test(numbers, Alternative::greater);
  if (above)
    return OneSided{above->p_value, stats::paired_t_test(numbers, Alternative::less)->p_value};
  return OneSided{stats::sign_flip_test(numbers, Alternative::greater)->p_value,
                  stats::sign_flip_test(numbers, Alternative::less)->p_value};
}

double average_of(std::span<const double> numbers, Average average) {
  return average == Average::mean ? stats::mean(numbers) : stats::quantile(numbers, 0.5);
}

std::optional<stats::Interval> interval_of(std::span<const double> numbers, Average average) {
  return average == Average::mean ? stats::t_interval(numbers, confidence)
                                  : median_interval(numbers);
}

void judge(Contrast& contrast, std::span<const double> shown,
           std::vector<std::vector<double>> conditions, Average average) {
  contrast.n = static_cast<int>(shown.size());
  if (shown.empty()) return;
  contrast.estimate = average_of(shown, average);
  contrast.interval = interval_of(shown, average);
  double holds = 0.0, fails = 1.0;
  for (const std::vector<double>& numbers : conditions) {
    const std::optional<OneSided> p = one_sided(numbers, average);
    if (!p) return;
    holds = std::max(holds, p->above);
    fails = std::min(fails, p->below);
  }
  contrast.p_holds = std::min(1.0, 2.0 * holds);
  contrast.p_fails = std::min(1.0, 2.0 * fails);
  if (average == Average::mean) contrast.conditions = std::move(conditions);
}

}  // namespace shoal::analysis
