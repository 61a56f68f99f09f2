#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "shoal/analysis/experiments/claims/claim_verdicts.hpp"
#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

// From the file of a study to its tables there is one way, which the program, Python and dask
// share: planned_study(), then sweep() or an OpenSweep, then a SweptStudy.

/// A study that can be swept, and its tables and claims answered.
struct PlannedStudy {
  TrialList list;
  std::size_t tables = 0;  ///< that there will be, that of the claims among them
};

/// `replications` stand for those of the study, if above 0. Throws InputError if the study is none,
/// or asks for what it does not have: better before its trials than after.
PlannedStudy planned_study(Setting study, std::int64_t replications = 0);

/// What the folder of a sweep says. Its trials are read once; tables and claims are made when they
/// are first asked for.
class SweptStudy {
 public:
  /// Throws InputError if the folder is none of a sweep, or if its trials contradict each other.
  explicit SweptStudy(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  const StudyResults& results() const { return results_; }
  const std::vector<Table>& tables();
  const Judgement& claims();

  /// Writes tables/NAME.{tex,csv,md}, that of the claims among them; returns how many tables.
  std::size_t write_tables();

 private:
  std::filesystem::path folder_;
  StudyResults results_;
  std::optional<std::vector<Table>> tables_;
  std::optional<Judgement> claims_;
};

}  // namespace shoal::analysis
