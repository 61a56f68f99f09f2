#include "shoal/analysis/experiments/results/paired_test.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/paired_tests.hpp"

namespace shoal::analysis {

std::string_view name_of(PairedTest test) {
  switch (test) {
    case PairedTest::sign_flip:
      return "sign-flip";
    case PairedTest::wilcoxon:
      return "Wilcoxon signed-rank";
    case PairedTest::paired_t:
      return "paired t";
  }
  return "?";
}

namespace {

std::optional<double> p_value(const statistics::Differences& differences, PairedTest test) {
  if (differences.empty()) return std::nullopt;
  if (differences.all_zero()) return 1.0;
  const auto p_of = [](const std::optional<statistics::TestResult>& result) {
    return result ? std::optional(result->p_value) : std::nullopt;
  };
  switch (test) {
    case PairedTest::sign_flip:
      return p_of(statistics::sign_flip_test(differences));
    case PairedTest::wilcoxon:
      return p_of(statistics::signed_rank_test(differences));
    case PairedTest::paired_t:
      return p_of(statistics::paired_t_test(differences));
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<double>> paired_p_values(
    const std::vector<statistics::Differences>& samples, PairedTest test) {
  std::vector<std::optional<double>> p_values(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(),
                    [&](std::size_t i) { p_values[i] = p_value(samples[i], test); });
  return p_values;
}

bool at_floor(double p_value, const statistics::Differences& differences, PairedTest test) {
  const auto some = std::ranges::count_if(differences.values(),
                                          [&](double x) { return !differences.is_zero(x); });
  return some > 0 &&
         p_value <= statistics::least_p_value(test, static_cast<int>(some)) * (1.0 + 1e-9);
}

std::optional<std::string> note_on_floor(const std::vector<statistics::Differences>& samples,
                                         PairedTest test) {
  std::size_t tests = 0, most = 0;
  for (const statistics::Differences& each : samples) {
    tests += each.empty() ? 0 : 1;
    most = std::max(most, each.size());
  }
  if (tests == 0 || test == PairedTest::paired_t) return std::nullopt;
  const auto least = [&](int n) {
    return std::min(1.0, static_cast<double>(tests) * statistics::least_p_value(test, n));
  };
  const std::string of =
      fmt::format("The least p that a {} test of {} differences can give, ", name_of(test), most) +
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
