#pragma once

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

/// The table that a study asks for. Throws InputError if it asks for what the study does not have.
Table cell_table(const TableRequest& request, const StudyResults& results);

}  // namespace shoal::analysis
