#include <algorithm>

#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

enum class Shape { valley, peak };

struct TurnsOptions : WithSmallestEffect {
  std::string along;
  Shape shape = Shape::valley;

  static void declare(Options<TurnsOptions>& o) {
    using T = TurnsOptions;
    o.text("along", &T::along, "the factor, its levels in the order of the study");
    o.word("shape", &T::shape, {{"valley", Shape::valley}, {"peak", Shape::peak}},
           "first falls, then rises; or the other way round");
    declare_smallest_effect(o);
  }
};

/// The answer first falls and then rises along a factor: some level between the ends lies below
/// both. As any will do, its p-value counts as often as there are such levels (Bonferroni); the
/// claim fails if each of them is not below one of the ends.
class Turns final : public ClaimTest {
 public:
  explicit Turns(const TurnsOptions& options)
      : along_(options.along),
        sign_(options.shape == Shape::valley ? 1.0 : -1.0),
        margin_(options.margin()) {}

  std::vector<std::string> compared() const override { return {along_}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    require_levels(scope, along_, 3);
    const std::size_t last = scope.cells.size() - 1;
    std::optional<Contrast> best;
    double fails = 0.0;
    for (std::size_t level = 1; level < last; ++level) {
      const CellPlace inner = scope.cells[level];
      Contrast nearer = rise(scope, inner, scope.cells.front());
      Contrast other = rise(scope, inner, scope.cells.back());
      if (other.p_holds.value_or(1.0) > nearer.p_holds.value_or(1.0)) std::swap(nearer, other);
      fails = std::max(fails,
                       2.0 * std::min(nearer.p_fails.value_or(1.0), other.p_fails.value_or(1.0)));
      if (!best || nearer.p_holds.value_or(1.0) < best->p_holds.value_or(1.0)) {
        best = std::move(nearer);
      }
    }
    const auto inner_levels = static_cast<double>(last - 1);
    if (best->p_holds) best->p_holds = std::min(1.0, inner_levels * *best->p_holds);
    if (best->p_fails) best->p_fails = std::min(1.0, fails);
    best->conditions.clear();
    return {*best};
  }

 private:
  /// From an inner level to an end.
  Contrast rise(const ClaimScope& scope, CellPlace inner, CellPlace end) const {
    Contrast contrast = directed_difference(scope, end, inner, sign_, margin_);
    contrast.title = scope.label(end, {along_}) + " - " + scope.label(inner, {along_});
    return contrast;
  }

  std::string along_;
  double sign_;
  Margin margin_;
};

const Register<ClaimTest, TurnsOptions> registered{
    "turns", "the answer first falls and then rises along a factor, or the other way round",
    [](const TurnsOptions& options) { return std::make_unique<Turns>(options); }};

}  // namespace
}  // namespace shoal::analysis
