#include "shoal/analysis/study/needed_series.hpp"

#include <set>

namespace shoal::analysis {

std::vector<std::string> needed_series(const Study& study) {
  std::set<std::string> names(study.series.begin(), study.series.end());
  for (const TableRequest& table : study.tables) {
    names.insert(table.series.begin(), table.series.end());
    if (!table.against.empty()) names.insert(table.against);
  }
  for (const Claim& claim : study.claims) {
    if (!claim.series.empty()) names.insert(claim.series);
  }
  return {names.begin(), names.end()};
}

}  // namespace shoal::analysis
