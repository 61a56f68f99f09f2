#pragma once

#include "shoal/analysis/experiments/pipeline.hpp"

namespace shoal::analysis {

/// Writes report.html into the folder of a study: tables, figures (those that stand in
/// its folder `figures`), claims with their verdicts, what failed, and how the numbers came to be.
/// Throws SystemError if it cannot be written.
void write_study_report(SweptStudy& study);

}  // namespace shoal::analysis
