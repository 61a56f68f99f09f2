#pragma once

#include <filesystem>

#include "shoal/analysis/study/plan.hpp"

namespace shoal::analysis {

/// Writes study.toml (with every file it names made absolute, or copied beside it) and claims.toml.
void write_study(const StudyPlan& plan, const std::filesystem::path& folder);

/// The study that a sweep left in a folder. Throws InputError if there is none.
StudyPlan stored_plan(const std::filesystem::path& folder);

}  // namespace shoal::analysis
