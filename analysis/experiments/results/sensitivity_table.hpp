#pragma once

#include <vector>

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// The sensitivities of answers to the factors of a group, as the analysis of its design tells
/// them, with 95 % bootstrap intervals. Throws InputError if the study has no such group, if there
/// is no analysis of its design, or if one of its factors does not apply in all cells.
std::vector<Table> sensitivity_tables(const SensitivityRequest& request,
                                      const StudyResults& results);

}  // namespace shoal::analysis
