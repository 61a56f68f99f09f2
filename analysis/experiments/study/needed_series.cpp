#include "shoal/analysis/experiments/study/needed_series.hpp"

#include <set>

namespace shoal::analysis {

std::vector<std::string> needed_series(const Study& study) {
  std::set<std::string> names(study.series.begin(), study.series.end());
  for (const TableRequest& table : study.tables) {
    names.insert(table.series.begin(), table.series.end());
    if (!table.against.empty()) names.insert(table.against);
  }
  for (const TestedStatement* asked : tested_on_the_study(study.claims)) {
    if (asked->series.empty()) continue;
    names.insert(asked->series);
    if (!asked->minus.empty()) names.insert(asked->minus);
  }
  return {names.begin(), names.end()};
}

}  // namespace shoal::analysis
