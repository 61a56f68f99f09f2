#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_scope.hpp"

namespace shoal::analysis {

enum class Verdict { reproduced, contradicted, undecided };
std::string_view name_of(Verdict verdict);

/// What the trials say to a claim.
struct ClaimResult {
  std::vector<Contrast> contrasts;
  /// Two-sided p-values: the claim holds if every contrast does; it fails if any does, corrected
  /// for their number (Bonferroni). 1 where the trials say nothing.
  double p_holds = 1.0, p_fails = 1.0;
  /// What the smaller of the two is multiplied by, since other claims are tested, too.
  double correction = 1.0;

  /// Whether anything is inferred, and not only seen in each trial.
  bool inferred() const;
  Verdict verdict() const;
  Verdict verdict_of(const Contrast& contrast) const;
  /// Whether an undecided claim would be decided without the correction.
  bool corrected_away() const;
  /// Where undecided: replications that would decide it with a chance of 80 %, if means and scatter
  /// are as they seem, at the level that the correction leaves; nothing if 10,000 would not, and
  /// for claims that are not on means.
  std::optional<int> replications_needed() const;
};

/// Tests a claim in the cells that `where` leaves, not corrected for other claims. Throws
/// InputError if the claim names what the study does not have.
ClaimResult test_claim(const TestedStatement& asked, const Setting& where,
                       const StudyResults& results);

}  // namespace shoal::analysis
