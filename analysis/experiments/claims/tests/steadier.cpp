#include "shoal/analysis/experiments/claims/tests/margin.hpp"
#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/paired_spread.hpp"

namespace shoal::analysis {
namespace {

struct SteadierOptions {
  Setting cells, than;
  double smallest_effect_percent = 0.0;

  static void declare(Options<SteadierOptions>& o) {
    using S = SteadierOptions;
    o.setting("cells", &S::cells, "a table: factor = label",
              "the cells whose numbers are said to scatter less over trials");
    o.setting("than", &S::than, "a table or a list of tables: factor = label",
              "those they are compared with");
    o.number("smallest_effect_percent", &S::smallest_effect_percent, "%", in(0, 99),
             "the least reduction of the other's standard deviation that matters");
  }

  std::optional<std::string> complaint() const {
    if (smallest_effect_percent == 0.0) return "needs smallest_effect_percent, above 0";
    return std::nullopt;
  }
};

/// The numbers of one level scatter less over trials than those of others: the test of Pitman and
/// Morgan, for pairs of normal numbers that share a seed.
class Steadier final : public ClaimTest {
 public:
  explicit Steadier(const SteadierOptions& options)
      : cells_(options.cells),
        than_(cell_selections(options.than, "than")),
        ratio_(1.0 - options.smallest_effect_percent / 100.0) {}

  std::vector<std::string> compared() const override { return factors_of(cells_, than_); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    require_mean(scope.asked, "steadier");
    const CellPlace ours = scope.cell(cells_);
    std::vector<Contrast> contrasts;
    for (const CellSelection& other : than_) {
      contrasts.push_back(ratio_of_spreads(scope.numbers({ours, scope.cell(other)})));
      contrasts.back().title = cells_.text() + " / " + other.text();
    }
    return contrasts;
  }

 private:
  Contrast ratio_of_spreads(const SharedNumbers& numbers) const {
    using statistics::Alternative;
    Contrast contrast = counted(numbers, "");
    contrast.quantity = "ratio of standard deviations";
    contrast.claimed = "below " + number_text(ratio_, "");
    contrast.against = Against::too_small;
    contrast.estimate = statistics::spread_ratio(numbers.of[0], numbers.of[1]);
    contrast.interval = statistics::spread_ratio_interval(numbers.of[0], numbers.of[1], confidence);
    if (!contrast.interval) return contrast;
    if (contrast.interval->low > 1.0) contrast.against = Against::opposite;
    std::vector<double> scaled = numbers.of[1];
    for (double& x : scaled) x *= ratio_;
    const auto p = [&](Alternative alternative) {
      return std::min(1.0,
                      2.0 * statistics::spread_test(numbers.of[0], scaled, alternative)->p_value);
    };
    contrast.p_holds = p(Alternative::less);
    contrast.p_fails = p(Alternative::greater);
    return contrast;
  }

  CellSelection cells_;
  std::vector<CellSelection> than_;
  double ratio_;
};

const Register<ClaimTest, SteadierOptions> registered{
    "steadier", "the numbers of one level scatter less over trials than those of others",
    [](const SteadierOptions& options) { return std::make_unique<Steadier>(options); }};

}  // namespace
}  // namespace shoal::analysis
