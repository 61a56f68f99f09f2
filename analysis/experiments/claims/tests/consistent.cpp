#include "shoal/analysis/experiments/claims/tests/margin.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/variation.hpp"

namespace shoal::analysis {
namespace {

/// A number differs little from trial to trial: its standard deviation is at most a share of its
/// mean.
struct Consistent final : ClaimTest {
  double within_percent = 0.0;

  static void declare(Options<Consistent>& o) {
    o.number("within_percent", &Consistent::within_percent, "%", at_least(0),
             "the most that the standard deviation may be of the mean");
  }

  std::optional<std::string> complaint() const {
    if (within_percent == 0.0) return "needs within_percent, above 0";
    return std::nullopt;
  }

  std::vector<std::string> compared() const override { return {}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    require_mean(scope.asked, "consistent");
    std::vector<Contrast> contrasts;
    for (const CellPlace cell : scope.cells) {
      const SharedNumbers numbers = scope.numbers({cell});
      Contrast& contrast = contrasts.emplace_back(counted(numbers, "%"));
      contrast.quantity = "coefficient of variation";
      contrast.claimed = "at most " + number_text(within_percent, "%");
      const auto variation = statistics::variation(numbers.of[0]);
      if (!variation) continue;
      const auto interval = statistics::variation_interval(numbers.of[0], confidence);
      const auto p = statistics::variation_test(numbers.of[0], within_percent / 100.0);
      contrast.estimate = 100.0 * *variation;
      contrast.interval = {100.0 * interval->low, 100.0 * interval->high};
      contrast.p_holds = std::min(1.0, 2.0 * p->below);
      contrast.p_fails = std::min(1.0, 2.0 * p->above);
    }
    return contrasts;
  }
};

const Register<ClaimTest, Consistent> registered{
    "consistent", "a number differs little from trial to trial, by its coefficient of variation"};

}  // namespace
}  // namespace shoal::analysis
