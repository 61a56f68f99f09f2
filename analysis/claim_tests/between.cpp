#include <cmath>
#include <limits>

#include "shoal/analysis/study/claim.hpp"

namespace shoal::analysis {
namespace {

/// A number lies between two others, in every cell that the claim is about: its mean, or that of
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
    return std::nullopt;
  }

  std::vector<std::string> compared() const override { return {}; }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    std::vector<Contrast> contrasts;
    for (const std::size_t cell : scope.cells) {
      Contrast contrast;
      contrast.of_each = of_each;
      for (const std::optional<double>& answer : scope.answers(cell)) {
        if (answer) contrast.numbers.push_back(*answer);
        if (!answer) ++contrast.missing;
      }
      if (std::isfinite(at_least)) contrast.low = at_least;
      if (std::isfinite(at_most)) contrast.high = at_most;
      contrasts.push_back(std::move(contrast));
    }
    return contrasts;
  }
};

const Enrol<ClaimTest, Between<false>> mean{"between", "a mean lies between two numbers"};
const Enrol<ClaimTest, Between<true>> each{"each_between",
                                           "in each trial, a number lies between two others"};

}  // namespace
}  // namespace shoal::analysis
