#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shoal/analysis/statistics/intervals.hpp"

namespace shoal::analysis {

/// What of the numbers over trials a claim is on.
enum class Average { mean, median };

/// Why a contrast that contradicts its claim does.
enum class Against {
  outside,    ///< the number is not where it is said to be
  opposite,   ///< the difference has the other sign
  too_small,  ///< there is no difference that matters
};

/// One comparison that a claim comes down to: what the trials estimate, what is claimed of it, and
/// how the trials speak for and against.
struct Contrast {
  std::string title;     ///< which cells; "" where there is only one
  std::string quantity;  ///< what is estimated, where it is not the number itself: `difference`
  std::string unit;
  std::string claimed;  ///< `below -1.5 Wh`
  std::optional<double> estimate;
  std::optional<statistics::Interval> interval;  ///< of 95 %, or the range of a claim on each trial
  bool of_each = false;   ///< on each of the trials themselves: nothing is inferred
  int n = 0;              ///< numbers, or pairs of them
  int trials = 0;         ///< that should have given one
  int never_reached = 0;  ///< of n: those that wait for an event that did not come
  /// Two-sided p-values: how surprising the trials would be if the claim did not hold, and if it
  /// did. Nothing where they say nothing about their scatter; of each: 0 or 1.
  std::optional<double> p_holds, p_fails;
  Against against = Against::outside;
  /// Of each condition of a claim on means, the numbers whose mean is said to be above 0.
  std::vector<std::vector<double>> conditions;
};

/// One-sided p-values against "the average is at most 0" and "... at least 0".
struct OneSided {
  double above = 1.0, below = 1.0;
};

/// Of means by Student's t; of numbers that are all the same, which have no scatter, by the exact
/// sign-flip test. Of medians by the exact sign test, in which a 0 speaks for neither side. Nothing
/// for no numbers, and for numbers that are all 0.
std::optional<OneSided> one_sided(std::span<const double> numbers, Average average);

double average_of(std::span<const double> numbers, Average average);

/// Of 95 %: Student's, or that between order statistics (exact, and at least so wide). Nothing
/// where there is none.
std::optional<statistics::Interval> interval_of(std::span<const double> numbers, Average average);

/// Estimates the average of `shown` and tests the conditions: of each, the average of its numbers
/// is said to be above 0. The claim holds if all do (an intersection-union test), and fails if one
/// does not; no two of them can fail together.
void judge(Contrast& contrast, std::span<const double> shown,
           std::vector<std::vector<double>> conditions, Average average);

}  // namespace shoal::analysis
