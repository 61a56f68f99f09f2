#include <algorithm>

#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

enum class Direction { falls, rises };

struct TrendOptions : WithSmallestEffect {
  std::string along;
  Direction direction = Direction::falls;

  static void declare(Options<TrendOptions>& o) {
    using T = TrendOptions;
    o.text("along", &T::along, "the factor, its levels in the order of the study");
    o.word("direction", &T::direction, {{"falls", Direction::falls}, {"rises", Direction::rises}},
           "what the answer does");
    declare_smallest_effect(o);
  }
};

/// What the least-squares line over the numbers of the levels changes by, from the first to the
/// last.
double change_along(const std::vector<double>& numbers) {
  const double last = static_cast<double>(numbers.size()) - 1.0;
  double rise = 0.0, width = 0.0;
  for (std::size_t level = 0; level < numbers.size(); ++level) {
    const double x = static_cast<double>(level) - last / 2.0;
    rise += x * numbers[level];
    width += x * x;
  }
  return rise / width * last;
}

/// The answer falls or rises from level to level of a factor, seed by seed.
class Trend final : public ClaimTest {
 public:
  explicit Trend(const TrendOptions& options)
      : along_(options.along),
        sign_(options.direction == Direction::rises ? 1.0 : -1.0),
        margin_(options.margin()) {}

  std::vector<std::string> compared() const override { return {along_}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    require_levels(scope, along_, 2);
    const SharedNumbers numbers = scope.numbers(scope.cells);
    std::vector<double> changes, means, beyond;
    for (std::size_t k = 0; k < numbers.count(); ++k) {
      std::vector<double> along;
      for (const auto& of_cell : numbers.of) along.push_back(of_cell[k]);
      changes.push_back(change_along(along));
      means.push_back(statistics::mean(along));
      beyond.push_back(sign_ * changes.back() - margin_.beside(means.back()));
    }
    Contrast contrast = counted(numbers, scope.asked.unit());
    contrast.title = scope.label(scope.cells.front(), {along_}) + " to " +
                     scope.label(scope.cells.back(), {along_});
    contrast.quantity = "change of the line";
    contrast.claimed =
        (sign_ > 0.0 ? "above " : "below -") + margin_.text(means, contrast.unit, "the mean");
    judge(contrast, changes, {std::move(beyond)}, scope.asked.average);
    set_against(contrast, sign_);
    return {contrast};
  }

 private:
  std::string along_;
  double sign_;
  Margin margin_;
};

const Register<ClaimTest, TrendOptions> registered{
    "trend", "the answer falls or rises along a factor, seed by seed",
    [](const TrendOptions& options) { return std::make_unique<Trend>(options); }};

}  // namespace
}  // namespace shoal::analysis
