#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_verdicts.hpp"
#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// What the tables and claims of a study need, read from its store.
StudyResults read_results(const TrialList& list, const std::filesystem::path& folder);

/// Throws InputError if a table or a claim asks for what the study does not have: better before its
/// trials than after. Returns how many tables there will be, that of the claims among them.
std::size_t require_answerable(const TrialList& list);

/// Every table that the study asks for, in its order; a study that asks for none gets one for each
/// group: every factor in the rows, a few measures in the columns. Throws InputError.
std::vector<Table> study_tables(const StudyResults& results);

/// How the files of a table end: one for each format that has files.
std::vector<std::string> file_endings_of_tables();

/// Writes tables/NAME.ENDING of each table into the folder, that of the claims (if any) last, and
/// takes away what earlier tables left there. Returns how many tables there are.
std::size_t write_tables(std::vector<Table> tables, const Judgement& claims,
                         const std::filesystem::path& folder);

}  // namespace shoal::analysis
