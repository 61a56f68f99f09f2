#pragma once

#include <filesystem>

#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

/// Writes study.toml (with every file it names made absolute, or copied beside it) and claims.toml.
void write_study(const TrialList& list, const std::filesystem::path& folder);

/// The study that a sweep left in a folder. Throws InputError if there is none.
TrialList stored_list(const std::filesystem::path& folder);

}  // namespace shoal::analysis
