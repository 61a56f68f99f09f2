#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim.hpp"

namespace shoal::analysis {

/// What was found of the cause of a contradiction.
struct JudgedCause {
  std::optional<ClaimResult> result;  ///< of the cause's own test
  std::string missing_study;          ///< the study that shows it, if that is not stored

  bool established() const { return result && result->verdict() == Verdict::reproduced; }
};

/// A claim in one column.
struct JudgedColumn {
  ClaimResult result;
  double corrected_p = 1.0;  ///< of the smaller of its p-values
  std::optional<JudgedCause> cause;
};

struct JudgedClaim {
  Claim claim;
  std::vector<std::optional<JudgedColumn>> columns;  ///< nothing where it is not about that level

  std::optional<Verdict> verdict(std::size_t column) const;
};

/// A claim that stands alone, or a statement with its parts.
struct JudgedStatement {
  std::int64_t number = 0;
  std::string section, says;
  std::string not_tested;  ///< why; "" if it is
  std::vector<JudgedClaim> parts;

  /// Reproduced if all parts are, contradicted if any is. Nothing where no part is about that
  /// level.
  std::optional<Verdict> verdict(std::size_t column) const;
  /// `reproduced`, `not tested`, or `-`.
  std::string verdict_text(std::size_t column) const;
};

struct Judgement {
  std::vector<std::string> columns;  ///< levels that have verdicts of their own; "" for all trials
  Correction correction = Correction::none;
  int family = 0;  ///< verdicts that the correction is over: those in which something is inferred
  std::vector<JudgedStatement> statements;  ///< by number, then those without one

  bool side_by_side() const { return columns.size() > 1 || !columns.front().empty(); }
};

/// Tests all claims of a study. `folder` is where its trials are stored: the studies that causes
/// name are looked for beside it, and in out/. Throws InputError if a claim names what its study
/// does not have.
Judgement judged_claims(const StudyResults& results, const std::filesystem::path& folder);

/// Throws InputError if a claim or a cause asks for what the study does not have.
void require_answerable_claims(const StudyResults& results);

}  // namespace shoal::analysis
