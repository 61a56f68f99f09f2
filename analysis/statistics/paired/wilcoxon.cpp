#include <algorithm>
#include <cmath>
#include <numbers>

#include "shoal/analysis/statistics/paired_test.hpp"
#include "shoal/analysis/statistics/power.hpp"
#include "shoal/analysis/statistics/simulated_power.hpp"

namespace shoal::analysis::statistics {
namespace {

/// The greatest sum of ranks of one sign that Wilcoxon's test of n differences still rejects; -1
/// for none.
int critical_sum(int n, double alpha) {
  const auto all = static_cast<std::size_t>(n * (n + 1) / 2);
  std::vector<double> chance(all + 1);
  chance[0] = 1.0;
  for (std::size_t rank = 1; rank <= static_cast<std::size_t>(n); ++rank) {
    for (std::size_t s = all; s >= rank; --s) chance[s] = (chance[s] + chance[s - rank]) / 2.0;
    for (std::size_t s = 0; s < rank; ++s) chance[s] /= 2.0;
  }
  std::size_t sums = 0;  // that are rare enough, from 0 on
  double below = 0.0;
  while (2.0 * (below += chance[sums]) <= alpha) ++sums;
  return static_cast<int>(sums) - 1;
}

bool signed_rank_rejects(std::vector<double> differences, int critical) {
  std::ranges::sort(differences, {}, [](double x) { return std::abs(x); });
  int above = 0, all = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const int rank = static_cast<int>(i) + 1;
    if (differences[i] > 0.0) above += rank;
    all += rank;
  }
  return std::min(above, all - above) <= critical;
}

struct SignedRanks final : PairedTest {
  std::string title() const override { return "Wilcoxon signed-rank"; }

  std::optional<TestResult> test(const Differences& differences) const override {
    return signed_rank_test(differences);
  }
  double least_p_value(int n) const override { return std::ldexp(1.0, 1 - n); }

  double power(int n, double effect, double alpha) const override {
    if (n > most_simulated_differences) {
      // Of large samples (Lehmann 1975, sec. 4.2).
      return paired_t_power(n, std::sqrt(3.0 * std::numbers::inv_pi) * effect, 1.0, alpha);
    }
    const int critical = critical_sum(n, alpha);
    return simulated_power(n, effect, [&](std::vector<double> sample) {
      return signed_rank_rejects(std::move(sample), critical);
    });
  }

  static void declare(Options<SignedRanks>&) {}
};

const Register<PairedTest, SignedRanks> registered{"wilcoxon",
                                                   "Wilcoxon's signed-rank test (1945)"};

}  // namespace
}  // namespace shoal::analysis::statistics
