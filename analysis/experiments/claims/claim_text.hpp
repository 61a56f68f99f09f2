#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_verdicts.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// `rigid - pairwise: difference -1.2 Wh [-3.4, 1], claimed below -1.5 Wh, n = 5: undecided`.
std::string contrast_text(const ClaimResult& result, const Contrast& contrast);

/// All that is said below a claim in one column: its contrasts, their p-value, how many
/// replications would decide, and, of a contradiction, its cause.
std::vector<std::string> claim_lines(const JudgedClaim& judged, std::size_t column,
                                     const Judgement& judgement);

/// `55 statements: 30 reproduced, 20 contradicted, 3 undecided, 2 not tested`; with several columns
/// a line for each, which its name begins.
std::vector<std::string> count_lines(const Judgement& judgement);

/// How verdicts come about, in a sentence or three.
std::string verdict_note(const Judgement& judgement);

/// Number, section, words, verdicts and numbers of every statement and of its parts.
Table claims_table(const Judgement& judgement);

}  // namespace shoal::analysis
