#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_scope.hpp"

namespace shoal::analysis {

/// The least difference that matters, or how far two numbers that count as alike may be apart.
struct Margin {
  double absolute = 0.0;
  double percent = 0.0;  ///< instead, of the other's value

  double beside(double other) const;
  /// `1.5 Wh`, or `5 % of the other's (1.9 Wh)`, of the mean of the others' values. `others` says
  /// what they are.
  std::string text(const std::vector<double>& values, const std::string& unit,
                   const std::string& others = "the other's") const;
};

/// Throws InputError, at `origin`, unless one of its numbers is given; `name` is what the options
/// are called.
Margin given_margin(const Margin& margin, const std::string& name, const Origin& origin);

/// Options `smallest_effect` and `smallest_effect_percent`, one of which must be given.
struct WithSmallestEffect {
  double smallest_effect = 0.0, smallest_effect_percent = 0.0;
  Origin origin;
  Margin margin() const {
    return given_margin({smallest_effect, smallest_effect_percent}, "smallest_effect", origin);
  }
};
template <class T>
void declare_smallest_effect(Options<T>& o) {
  o.number("smallest_effect", &T::smallest_effect, "", at_least(0),
           "the least difference that matters, in the unit of the measure");
  o.number("smallest_effect_percent", &T::smallest_effect_percent, "%", at_least(0),
           "the same, as a share of the other's value");
}

/// Options `within` and `within_percent`, one of which must be given.
struct WithTolerance {
  double within = 0.0, within_percent = 0.0;
  Origin origin;
  Margin margin() const { return given_margin({within, within_percent}, "within", origin); }
};
template <class T>
void declare_tolerance(Options<T>& o) {
  o.number("within", &T::within, "", at_least(0),
           "how far apart counts as alike, in the unit of the measure");
  o.number("within_percent", &T::within_percent, "%", at_least(0),
           "the same, as a share of the other's value");
}

/// A contrast on the difference of two cells, seed by seed, that is said to be above the margin
/// (sign 1) or below its negative (-1).
Contrast directed_difference(const ClaimScope& scope, CellPlace ours, CellPlace theirs, double sign,
                             const Margin& margin);

/// Says why a contrast contradicts, if it does, from the whole interval's side of 0.
void set_against(Contrast& contrast, double sign);

/// A contrast that knows of how many trials its numbers are.
Contrast counted(const SharedNumbers& numbers, const std::string& unit);

std::vector<double> differences(const std::vector<double>& ours, const std::vector<double>& theirs);

/// `-1.5 Wh`, with four digits.
std::string number_text(double number, const std::string& unit);

/// Throws InputError if the cells of a scope are not at least so many levels of a factor.
void require_levels(const ClaimScope& scope, const std::string& factor, std::size_t count);

/// Throws InputError if the statement asks for another statistic than the mean.
void require_mean(const TestedStatement& asked, const std::string& test);

}  // namespace shoal::analysis
