#include "shoal/analysis/experiments/results/paired_test.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "shoal/analysis/experiments/results/confidence.hpp"

namespace shoal::analysis {

namespace {

std::optional<double> p_value(const statistics::Differences& differences, const PairedTest& test) {
  if (differences.empty()) return std::nullopt;
  if (differences.all_zero()) return 1.0;
  const auto result = test.test(differences);
  return result ? std::optional(result->p_value) : std::nullopt;
}

}  // namespace

std::vector<std::optional<double>> paired_p_values(
    const std::vector<statistics::Differences>& samples, const PairedTest& test) {
  std::vector<std::optional<double>> p_values(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(),
                    [&](std::size_t i) { p_values[i] = p_value(samples[i], test); });
  return p_values;
}

bool at_floor(double p_value, const statistics::Differences& differences, const PairedTest& test) {
  const auto some = std::ranges::count_if(differences.values(),
                                          [&](double x) { return !differences.is_zero(x); });
  return some > 0 && p_value <= test.least_p_value(static_cast<int>(some)) * (1.0 + 1e-9);
}

std::optional<std::string> note_on_floor(const std::vector<statistics::Differences>& samples,
                                         const PairedTest& test) {
  std::size_t tests = 0, most = 0;
  for (const statistics::Differences& each : samples) {
    tests += each.empty() ? 0 : 1;
    most = std::max(most, each.size());
  }
  if (tests == 0 || test.least_p_value(static_cast<int>(most)) == 0.0) return std::nullopt;
  const auto least = [&](int n) {
    return std::min(1.0, static_cast<double>(tests) * test.least_p_value(n));
  };
  const std::string of =
      fmt::format("The least p that a {} test of {} differences can give, ", test.title(), most) +
      (tests == 1 ? "of 1 comparison, is "
                  : fmt::format("corrected for {} comparisons, is ", tests));
  const std::string text = of + fmt::format("{:.2g}", least(static_cast<int>(most)));
  if (least(static_cast<int>(most)) <= significance)
    return text + ": differences can be significant.";
  int enough = static_cast<int>(most);
  while (enough < 100 && least(enough) > significance) ++enough;
  const std::string hope = least(enough) <= significance
                               ? fmt::format("; {} replications are the fewest that could", enough)
                               : "";
  return text + ": no difference could be significant here, however large" + hope + ".";
}

}  // namespace shoal::analysis
