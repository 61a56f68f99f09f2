#include <algorithm>
#include <cmath>
#include <limits>

#include "shoal/analysis/experiments/claims/tests/margin.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/proportion.hpp"

namespace shoal::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The share of trials that are so lies between two numbers.
struct Share final : ClaimTest {
  double trial_at_least = -infinity, trial_at_most = infinity;
  bool never_reached = false;
  double at_least = 0.0, at_most = 1.0;

  static void declare(Options<Share>& o) {
    o.number("trial_at_least", &Share::trial_at_least, "", Range{},
             "trials count whose number is at least this; default: no lower end");
    o.number("trial_at_most", &Share::trial_at_most, "", Range{},
             "and at most this; default: no upper end");
    o.flag("never_reached", &Share::never_reached,
           "instead, trials count in which the event that the number waits for never came");
    o.number("at_least", &Share::at_least, "", in(0, 1), "the share of trials that count");
    o.number("at_most", &Share::at_most, "", in(0, 1), "the share of trials that count");
  }

  std::optional<std::string> complaint() const {
    const bool bounded = std::isfinite(trial_at_least) || std::isfinite(trial_at_most);
    if (bounded == never_reached) {
      return "needs trial_at_least, trial_at_most or never_reached = true: which trials count";
    }
    if (trial_at_least > trial_at_most) return "trial_at_least must not be above trial_at_most";
    if (at_least >= at_most) return "at_least must be below at_most";
    if (at_least == 0.0 && at_most == 1.0) return "needs at_least or at_most: the share";
    return std::nullopt;
  }

  std::vector<std::string> compared() const override { return {}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    require_mean(scope.asked, "share");
    std::vector<Contrast> contrasts;
    for (const CellPlace cell : scope.cells) contrasts.push_back(share(scope, cell));
    return contrasts;
  }

 private:
  Contrast share(const ClaimScope& scope, CellPlace cell) const {
    const SharedNumbers numbers = scope.numbers({cell});
    Contrast contrast = counted(numbers, "");
    contrast.quantity = "share of trials " + counted_trials(scope.asked.unit());
    contrast.claimed = at_least > 0.0 ? "at least " + number_text(at_least, "") : "";
    if (at_most < 1.0) {
      contrast.claimed += (at_least > 0.0 ? ", at most " : "at most ") + number_text(at_most, "");
    }
    if (contrast.n == 0) return contrast;
    const auto inside = [&](double x) { return x >= trial_at_least && x <= trial_at_most; };
    const int count = never_reached
                          ? numbers.never_reached
                          : static_cast<int>(std::ranges::count_if(numbers.of[0], inside));
    contrast.estimate = static_cast<double>(count) / contrast.n;
    contrast.interval = statistics::clopper_pearson(count, contrast.n, confidence);
    double holds = 0.0, fails = 1.0;
    if (at_least > 0.0) {
      holds = std::max(holds, statistics::chance_of_at_least(count, contrast.n, at_least));
      fails = std::min(fails, statistics::chance_of_at_most(count, contrast.n, at_least));
    }
    if (at_most < 1.0) {
      holds = std::max(holds, statistics::chance_of_at_most(count, contrast.n, at_most));
      fails = std::min(fails, statistics::chance_of_at_least(count, contrast.n, at_most));
    }
    contrast.p_holds = std::min(1.0, 2.0 * holds);
    contrast.p_fails = std::min(1.0, 2.0 * fails);
    return contrast;
  }

  std::string counted_trials(const std::string& unit) const {
    if (never_reached) return "that never got there";
    const std::string low = "of at least " + number_text(trial_at_least, unit);
    const std::string high = "of at most " + number_text(trial_at_most, unit);
    if (!std::isfinite(trial_at_least)) return high;
    return std::isfinite(trial_at_most) ? low + " and " + high : low;
  }
};

const Register<ClaimTest, Share> registered{
    "share", "the share of trials in which a number is so lies between two others"};

}  // namespace
}  // namespace shoal::analysis
