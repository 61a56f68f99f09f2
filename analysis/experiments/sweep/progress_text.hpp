#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/sweep/sweep.hpp"

namespace shoal::analysis {

/// `40 of 120 trials, 0 failed, 3.1 a second, 26 s left`.
std::string progress_text(const SweepProgress& progress);

/// What a sweep leaves in its folder, in a line, and of trials that failed another one.
std::vector<std::string> summary_lines(const SweepProgress& progress,
                                       const std::filesystem::path& folder);

}  // namespace shoal::analysis
