#include "shoal/analysis/study/paired_test.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

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

std::optional<double> p_value(const std::vector<double>& differences, PairedTest test) {
  if (differences.empty()) return std::nullopt;
  if (std::ranges::all_of(differences, [](double d) { return d == 0.0; })) return 1.0;
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

std::vector<std::optional<double>> paired_p_values(const std::vector<std::vector<double>>& samples,
                                                   PairedTest test) {
  std::vector<std::optional<double>> p_values(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(),
                    [&](std::size_t i) { p_values[i] = p_value(samples[i], test); });
  return p_values;
}

}  // namespace shoal::analysis
