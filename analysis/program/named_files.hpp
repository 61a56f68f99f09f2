#pragma once

#include <filesystem>
#include <string>

namespace shoal::program {

// Of a path, or of a name that ships. Both throw InputError, which names the right command where
// the other kind of file is given.
std::filesystem::path scenario_file(const std::string& name_or_path);
std::filesystem::path study_file(const std::string& name_or_path);

}  // namespace shoal::program
