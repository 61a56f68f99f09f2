#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/study/claim_request.hpp"
#include "shoal/analysis/study/results.hpp"
#include "shoal/analysis/study/selection.hpp"

namespace shoal::analysis {

/// The cells that a claim is about: those of one group in which only the factors it compares
/// differ.
struct ClaimScope {
  const StudyResults& results;
  const Question& question;
  std::size_t group = 0;
  std::vector<std::size_t> cells;
  std::string title;  ///< of the factors that are the same in all these cells; "" for none

  /// The only cell of the scope that a selection holds. Throws InputError if there is none, or
  /// more.
  std::size_t cell(const CellSelection& selection) const;
  /// Of each replication, the answer, or nothing.
  std::vector<std::optional<double>> answers(std::size_t cell) const;
};

enum class Verdict { reproduced, contradicted, undecided };
std::string_view name_of(Verdict verdict);

/// What the trials say to one contrast.
struct ContrastResult {
  std::string title;
  int n = 0;
  std::optional<double> mean, low, high;  ///< with Student's 95 % interval, or the range:
  bool of_each = false;                   ///< of a claim on each number
  Verdict verdict = Verdict::undecided;
};

struct ClaimResult {
  Verdict verdict = Verdict::undecided;
  std::vector<ContrastResult> contrasts;
  /// Where undecided: replications that would decide it with a chance of 80 %, if means and scatter
  /// are as they seem; nothing if 10,000 would not.
  std::optional<int> replications_needed;
};

/// Tests a claim. It is reproduced if every contrast is (each interval lies where the claim holds),
/// and contradicted if the interval of any lies where it does not, at a level corrected for their
/// number (Bonferroni). Throws InputError if the claim names what the study does not have.
ClaimResult test_claim(const Claim& claim, const StudyResults& results);

}  // namespace shoal::analysis
