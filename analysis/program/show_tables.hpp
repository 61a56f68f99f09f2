#pragma once

#include "shoal/analysis/experiments/pipeline.hpp"

namespace shoal::program {

/// Writes the tables of a study and prints them all, or, as a summary, the first.
void show_tables(analysis::SweptStudy& study, bool summary);

}  // namespace shoal::program
