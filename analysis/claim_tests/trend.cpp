#include <algorithm>

#include "shoal/analysis/study/claim.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

enum class Direction { falls, rises };

/// The answer falls or rises from level to level of a factor: the slope of the least-squares line
/// over the numbers of the levels, in each replication.
struct Trend final : ClaimTest {
  std::string along;
  Direction direction = Direction::falls;
  Origin origin;

  static void declare(Options<Trend>& o) {
    o.text("along", &Trend::along, "the factor, its levels in the order of the study");
    o.word("direction", &Trend::direction,
           {{"falls", Direction::falls}, {"rises", Direction::rises}}, "what the answer does");
  }

  std::vector<std::string> compared() const override { return {along}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const PlannedGroup& group = scope.results.plan().groups()[scope.group];
    if (std::ranges::find(group.columns(), along) == group.columns().end()) {
      throw InputError(origin, "the group " + group.name() + " has no factor \"" + along + '"' +
                                   suggestion(along, group.columns()));
    }
    if (scope.cells.size() < 2) throw InputError(origin, "a trend needs two levels of " + along);
    std::vector<std::vector<std::optional<double>>> answers;  // by level, then replication
    for (const std::size_t cell : scope.cells) answers.push_back(scope.answers(cell));
    Contrast contrast{"slope per level of " + along, {}, {}, {}};
    for (std::size_t k = 0; k < answers.front().size(); ++k) {
      if (const auto slope = slope_of(answers, k)) contrast.numbers.push_back(*slope);
    }
    (direction == Direction::rises ? contrast.low : contrast.high) = 0.0;
    return {contrast};
  }

 private:
  static std::optional<double> slope_of(
      const std::vector<std::vector<std::optional<double>>>& answers, std::size_t replication) {
    const double middle = (static_cast<double>(answers.size()) - 1.0) / 2.0;
    double rise = 0.0, width = 0.0;
    for (std::size_t level = 0; level < answers.size(); ++level) {
      const std::optional<double>& answer = answers[level][replication];
      if (!answer) return std::nullopt;
      const double x = static_cast<double>(level) - middle;
      rise += x * *answer;
      width += x * x;
    }
    return rise / width;
  }
};

const Enrol<ClaimTest, Trend> enrolled{"trend", "the answer falls or rises along a factor"};

}  // namespace
}  // namespace shoal::analysis
