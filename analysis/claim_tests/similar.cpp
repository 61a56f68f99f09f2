#include <cmath>

#include "shoal/analysis/statistics/sample.hpp"
#include "shoal/analysis/study/claim.hpp"

namespace shoal::analysis {
namespace {

struct SimilarOptions {
  Setting cells, to;
  double within_percent = 10.0;

  static void declare(Options<SimilarOptions>& o) {
    using S = SimilarOptions;
    o.setting("cells", &S::cells, "a table: factor = label", "the cells that are said to be alike");
    o.setting("to", &S::to, "a table: factor = label", "those they are compared with");
    o.number("within_percent", &S::within_percent, "%", above(0),
             "of the others' mean: what counts as alike");
  }
};

/// Two levels give nearly the same: a test of equivalence, since no difference found is no proof of
/// none (Schuirmann 1987).
class Similar final : public ClaimTest {
 public:
  explicit Similar(const SimilarOptions& options)
      : cells_(options.cells), to_(options.to), share_(options.within_percent / 100.0) {}

  std::vector<std::string> compared() const override { return cells_.factors(); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const auto ours = scope.answers(scope.cell(cells_));
    const auto theirs = scope.answers(scope.cell(to_));
    Contrast contrast{cells_.text() + " - " + to_.text(), {}, {}, {}};
    std::vector<double> reference;
    for (std::size_t k = 0; k < ours.size(); ++k) {
      if (!ours[k] || !theirs[k]) continue;
      contrast.numbers.push_back(*ours[k] - *theirs[k]);
      reference.push_back(*theirs[k]);
    }
    if (!reference.empty()) {
      contrast.high = share_ * std::abs(statistics::mean(reference));
      contrast.low = -*contrast.high;
    }
    return {contrast};
  }

 private:
  CellSelection cells_, to_;
  double share_;
};

const Enrol<ClaimTest, SimilarOptions> enrolled{
    "similar", "two levels give nearly the same, seed by seed",
    [](const SimilarOptions& options) { return std::make_unique<Similar>(options); }};

}  // namespace
}  // namespace shoal::analysis
