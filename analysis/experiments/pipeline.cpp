#include "shoal/analysis/experiments/pipeline.hpp"

#include <utility>

#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"

namespace shoal::analysis {

PlannedStudy planned_study(Setting study, std::int64_t replications) {
  if (replications > 0) set_replications(study, replications);
  TrialList list(read_study(study));
  const std::size_t tables = require_answerable(list);
  return {std::move(list), tables};
}

SweptStudy::SweptStudy(std::filesystem::path folder)
    : folder_(std::move(folder)), results_(read_results(stored_list(folder_), folder_)) {}

const std::vector<Table>& SweptStudy::tables() {
  if (!tables_) tables_ = study_tables(results_);
  return *tables_;
}

const Judgement& SweptStudy::claims() {
  if (!claims_) claims_ = judged_claims(results_, folder_);
  return *claims_;
}

std::size_t SweptStudy::write_tables() {
  return analysis::write_tables(tables(), claims(), folder_);
}

}  // namespace shoal::analysis
