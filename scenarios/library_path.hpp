#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal::scenarios {

/// The folder of scenarios and currents that ship with shoal: $SHOAL_LIBRARY if set, else beside
/// the program or library that runs.
std::filesystem::path library_path();

/// The file to open, with `library:` resolved. Throws InputError if it does not exist.
std::filesystem::path resolved(const FilePath& file);

/// Names of the scenarios in the library, sorted.
std::vector<std::string> library_scenarios();

/// Names of the sets of settings that ship for scenarios to inherit, sorted.
std::vector<std::string> library_sets();

/// The file of a set that ships.
std::filesystem::path set_file(const std::string& name);

}  // namespace shoal::scenarios
