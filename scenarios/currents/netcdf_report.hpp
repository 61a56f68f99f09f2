#pragma once

#include <filesystem>
#include <string>

namespace shoal::scenarios {

/// What shoal understands of a file of currents, in a few lines: grid, variables, units and
/// packing, time span, calendar, depth levels, share of missing values, speeds.
///
/// Throws InputError with the reason if the file would be refused as a `netcdf` current whatever
/// its options.
std::string describe_current_file(const std::filesystem::path& path);

}  // namespace shoal::scenarios
