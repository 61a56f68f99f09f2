#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

enum class Best { lowest, highest };

struct NearBestOptions : WithTolerance {
  Setting cells;
  Best best = Best::lowest;

  static void declare(Options<NearBestOptions>& o) {
    using N = NearBestOptions;
    o.setting("cells", &N::cells, "a table: factor = label",
              "the cell that is compared with all others in which only these factors differ");
    o.word("best", &N::best, {{"lowest", Best::lowest}, {"highest", Best::highest}},
           "which number is the best");
    declare_tolerance(o);
  }
};

/// No other level is better by more than a tolerance: one level is not inferior to any.
class NearBest final : public ClaimTest {
 public:
  explicit NearBest(const NearBestOptions& options)
      : cells_(options.cells),
        sign_(options.best == Best::highest ? 1.0 : -1.0),
        margin_(options.margin()) {}

  std::vector<std::string> compared() const override { return cells_.factors(); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const CellPlace ours = scope.cell(cells_);
    std::vector<Contrast> contrasts;
    for (const CellPlace other : scope.cells) {
      if (other.group == ours.group && other.cell == ours.cell) continue;
      contrasts.push_back(not_worse(scope, scope.numbers({ours, other})));
      contrasts.back().title = cells_.text() + " - " + scope.label(other, compared());
    }
    if (contrasts.empty()) {
      throw InputError(cells_.origin(), "no other cell to compare " + cells_.text() + " with");
    }
    return contrasts;
  }

 private:
  Contrast not_worse(const ClaimScope& scope, const SharedNumbers& numbers) const {
    const std::vector<double> shown = differences(numbers.of[0], numbers.of[1]);
    std::vector<double> allowed;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      allowed.push_back(sign_ * shown[k] + margin_.beside(numbers.of[1][k]));
    }
    Contrast contrast = counted(numbers, scope.asked.unit());
    contrast.quantity = "difference";
    contrast.claimed =
        (sign_ > 0.0 ? "above -" : "below ") + margin_.text(numbers.of[1], contrast.unit);
    judge(contrast, shown, {std::move(allowed)}, scope.asked.average);
    return contrast;
  }

  CellSelection cells_;
  double sign_;
  Margin margin_;
};

const Register<ClaimTest, NearBestOptions> registered{
    "near_best", "no other level of a factor is better by more than a tolerance, seed by seed",
    [](const NearBestOptions& options) { return std::make_unique<NearBest>(options); }};

}  // namespace
}  // namespace shoal::analysis
