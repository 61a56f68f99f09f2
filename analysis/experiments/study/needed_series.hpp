#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/experiments/study/study.hpp"

namespace shoal::analysis {

/// Names of the series that a study stores of every trial: those that its tables, its claims and
/// itself name. Sorted, each once.
std::vector<std::string> needed_series(const Study& study);

}  // namespace shoal::analysis
