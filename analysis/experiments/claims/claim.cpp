#include "shoal/analysis/experiments/claims/claim.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/analysis/experiments/results/confidence.hpp"
#include "shoal/analysis/statistics/power.hpp"

namespace shoal::analysis {
namespace {

/// Replications that would show the mean of some numbers to be above 0 (or below).
std::optional<int> needed(const std::vector<double>& numbers, double alpha) {
  if (numbers.size() < 2 || !statistics::standard_error(numbers)) return std::nullopt;
  const double mean = statistics::mean(numbers);
  if (mean == 0.0) return std::nullopt;
  return statistics::replications_for(mean, statistics::standard_deviation(numbers), alpha,
                                      wanted_power);
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::contradicted:
      return "contradicted";
    case Verdict::undecided:
      return "undecided";
  }
  return "?";
}

bool ClaimResult::inferred() const {
  return std::ranges::any_of(contrasts, [](const Contrast& c) { return !c.of_each; });
}

Verdict ClaimResult::verdict() const {
  if (p_holds * correction < significance) return Verdict::reproduced;
  return p_fails * correction < significance ? Verdict::contradicted : Verdict::undecided;
}

Verdict ClaimResult::verdict_of(const Contrast& contrast) const {
  const auto number = static_cast<double>(contrasts.size());
  if (contrast.p_holds.value_or(1.0) * correction < significance) return Verdict::reproduced;
  return contrast.p_fails.value_or(1.0) * number * correction < significance ? Verdict::contradicted
                                                                             : Verdict::undecided;
}

bool ClaimResult::corrected_away() const {
  return verdict() == Verdict::undecided && std::min(p_holds, p_fails) < significance;
}

std::optional<int> ClaimResult::replications_needed() const {
  if (verdict() != Verdict::undecided) return std::nullopt;
  // It takes one contrast to contradict, and all to reproduce.
  const double alpha = significance / correction;
  const double alpha_of_one = alpha / static_cast<double>(contrasts.size());
  std::optional<int> to_fail;
  int to_hold = 0;
  bool may_hold = true;
  for (const Contrast& contrast : contrasts) {
    if (contrast.conditions.empty()) may_hold = false;
    for (const std::vector<double>& numbers : contrast.conditions) {
      const bool holds = statistics::mean(numbers) > 0.0;
      const std::optional<int> n = needed(numbers, holds ? alpha : alpha_of_one);
      may_hold &= holds && n;
      if (holds && n) to_hold = std::max(to_hold, *n);
      if (!holds && n) to_fail = std::min(to_fail.value_or(*n), *n);
    }
  }
  if (to_fail) return to_fail;
  return may_hold ? std::optional(to_hold) : std::nullopt;
}

ClaimResult test_claim(const TestedStatement& asked, const Setting& where,
                       const StudyResults& results) {
  const auto test = asked.test.make();
  ClaimResult result;
  for (const ClaimScope& scope : claim_scopes(asked, where, results, test->compared())) {
    for (Contrast& contrast : test->contrasts(scope)) {
      if (!scope.title.empty()) {
        contrast.title = scope.title + (contrast.title.empty() ? "" : ": " + contrast.title);
      }
      result.contrasts.push_back(std::move(contrast));
    }
  }
  const auto number = static_cast<double>(result.contrasts.size());
  result.p_holds = 0.0;
  for (const Contrast& contrast : result.contrasts) {
    result.p_holds = std::max(result.p_holds, contrast.p_holds.value_or(1.0));
    result.p_fails = std::min(result.p_fails, number * contrast.p_fails.value_or(1.0));
  }
  return result;
}

}  // namespace shoal::analysis
