#pragma once

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// The Shapley share of each factor in the difference between the cell with all factors changed and
/// that with all at the reference, with Student's 95 % intervals from the seeds.
///
/// Throws InputError if the group is no grid of two levels of each factor, if the reference does
/// not name a level of each, or if `minus` has other factors or levels, or other replications.
Table attribution_table(const AttributionRequest& request, const StudyResults& results);

}  // namespace shoal::analysis
