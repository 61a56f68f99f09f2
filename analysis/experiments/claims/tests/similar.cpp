#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

struct SimilarOptions : WithTolerance {
  Setting cells, to;

  static void declare(Options<SimilarOptions>& o) {
    using S = SimilarOptions;
    o.setting("cells", &S::cells, "a table: factor = label", "the cells that are said to be alike");
    o.setting("to", &S::to, "a table or a list of tables: factor = label",
              "those they are compared with");
    declare_tolerance(o);
  }
};

/// Two levels give nearly the same: two one-sided tests, since no difference found is no proof of
/// none (Schuirmann 1987). A share of the other's value is taken seed by seed, so that the ends of
/// what counts as alike are not estimated from the sample that they judge: ours - (1 - d) theirs is
/// above 0, and ours - (1 + d) theirs below it (Berger and Hsu 1996, sec. 4).
class Similar final : public ClaimTest {
 public:
  explicit Similar(const SimilarOptions& options)
      : cells_(options.cells), to_(cell_selections(options.to, "to")), margin_(options.margin()) {}

  std::vector<std::string> compared() const override { return factors_of(cells_, to_); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const CellPlace ours = scope.cell(cells_);
    std::vector<Contrast> contrasts;
    for (const CellSelection& other : to_) {
      contrasts.push_back(likeness(scope, scope.numbers({ours, scope.cell(other)})));
      contrasts.back().title = cells_.text() + " - " + other.text();
    }
    return contrasts;
  }

 private:
  Contrast likeness(const ClaimScope& scope, const SharedNumbers& numbers) const {
    const std::vector<double> shown = differences(numbers.of[0], numbers.of[1]);
    std::vector<double> above, below;
    for (std::size_t k = 0; k < shown.size(); ++k) {
      const double margin = margin_.beside(numbers.of[1][k]);
      above.push_back(shown[k] + margin);
      below.push_back(margin - shown[k]);
    }
    Contrast contrast = counted(numbers, scope.asked.unit());
    contrast.quantity = "difference";
    contrast.claimed = "within " + margin_.text(numbers.of[1], contrast.unit);
    judge(contrast, shown, {std::move(above), std::move(below)}, scope.asked.average);
    return contrast;
  }

  CellSelection cells_;
  std::vector<CellSelection> to_;
  Margin margin_;
};

const Register<ClaimTest, SimilarOptions> registered{
    "similar", "two levels give nearly the same, seed by seed",
    [](const SimilarOptions& options) { return std::make_unique<Similar>(options); }};

}  // namespace
}  // namespace shoal::analysis
