#pragma once

#include <vector>

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// Sobol' indices of a group with the design `saltelli` (those of pairs too, if it has their cells,
/// and how they converge), or elementary effects of one with `morris`, each with its 95 % bootstrap
/// interval. Sobol' indices are those of the mean over seeds; for elementary effects the answer of
/// a cell is its mean over replications, missing if that of any replication is. Throws InputError
/// if the study has no such group, or if one of its factors does not apply in all cells.
std::vector<Table> sensitivity_tables(const SensitivityRequest& request,
                                      const StudyResults& results);

}  // namespace shoal::analysis
