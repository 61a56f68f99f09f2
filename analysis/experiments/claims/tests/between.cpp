#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

/// A number lies between two others, in every cell that the claim is about: its average, or that of
/// each trial.
template <bool of_each>
struct Between final : ClaimTest {
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();

  static void declare(Options<Between>& o) {
    o.number("at_least", &Between::at_least, "", Range{}, "lower end; default: none");
    o.number("at_most", &Between::at_most, "", Range{}, "upper end; default: none");
  }

  std::optional<std::string> complaint() const {
    if (at_least >= at_most) return "at_least must be below at_most";
    if (!std::isfinite(at_least) && !std::isfinite(at_most)) return "needs at_least or at_most";
    return std::nullopt;
  }

  std::vector<std::string> compared() const override { return {}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    if (of_each) require_mean(scope.asked, "each_between");
    std::vector<Contrast> contrasts;
    for (const CellPlace cell : scope.cells) {
      const SharedNumbers numbers = scope.numbers({cell});
      Contrast contrast = counted(numbers, scope.asked.unit());
      contrast.claimed = claimed(contrast.unit);
      if constexpr (of_each) {
        judge_each(contrast, numbers.of[0]);
      } else {
        judge_average(contrast, numbers.of[0], scope.asked.average);
      }
      contrasts.push_back(std::move(contrast));
    }
    return contrasts;
  }

 private:
  std::string claimed(const std::string& unit) const {
    const std::string low = "at least " + number_text(at_least, unit);
    const std::string high = "at most " + number_text(at_most, unit);
    if (!std::isfinite(at_least)) return high;
    return std::isfinite(at_most) ? low + ", " + high : low;
  }

  void judge_average(Contrast& contrast, const std::vector<double>& numbers,
                     Average average) const {
    std::vector<std::vector<double>> conditions;
    const auto require = [&](double end, double sign) {
      if (!std::isfinite(end)) return;
      auto& beyond = conditions.emplace_back();
      for (const double x : numbers) beyond.push_back(sign * (x - end));
    };
    require(at_least, 1.0);
    require(at_most, -1.0);
    judge(contrast, numbers, std::move(conditions), average);
  }

  /// It takes one number outside to contradict, and all inside to reproduce.
  void judge_each(Contrast& contrast, const std::vector<double>& numbers) const {
    contrast.of_each = true;
    if (numbers.empty()) return;
    const auto [least, greatest] = std::ranges::minmax(numbers);
    contrast.estimate = statistics::mean(numbers);
    contrast.interval = {least, greatest};
    const bool outside = least < at_least || greatest > at_most;
    contrast.p_fails = outside ? 0.0 : 1.0;
    contrast.p_holds = !outside && contrast.n == contrast.trials ? 0.0 : 1.0;
  }
};

const Register<ClaimTest, Between<false>> average{"between", "an average lies between two numbers"};
const Register<ClaimTest, Between<true>> each{"each_between",
                                              "in each trial, a number lies between two others"};

}  // namespace
}  // namespace shoal::analysis
