#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal::analysis {

/// Writes report.html into a folder that `shoal run` wrote: playback, charts, measures, scenario.
/// Returns what the page cannot show, in sentences that stand on it, too. Throws InputError if the
/// folder is none of a run or is damaged, SystemError if it cannot be written.
std::vector<std::string> write_run_report(const std::filesystem::path& folder);

}  // namespace shoal::analysis
