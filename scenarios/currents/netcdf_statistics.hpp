#pragma once

#include <filesystem>
#include <vector>

#include "shoal/scenarios/currents/current_statistics.hpp"

namespace shoal::scenarios {

/// Statistics of the current of a file in a drifting window, from the first time in the file on,
/// over five hours or as long as the file lasts, at its uppermost level. The window begins at the
/// origin of a projected grid where that lies inside it, else in the middle of the grid.
///
/// Throws InputError if the file would be refused as a `netcdf` current, if it holds less than two
/// looks of time (a file without a time axis lasts), or where the window leaves its data.
std::vector<CurrentStatistic> current_file_statistics(const std::filesystem::path& path);

}  // namespace shoal::scenarios
