#pragma once

#include <filesystem>

namespace shoal::analysis {

/// Writes report.html into a folder that `shoal sweep` wrote: tables, figures (those that stand in
/// its folder `figures`), claims with their verdicts, what failed, and how the numbers came to be.
/// Throws InputError if the folder is none of a study, SystemError if it cannot be written.
void write_study_report(const std::filesystem::path& folder);

}  // namespace shoal::analysis
