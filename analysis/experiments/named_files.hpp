#pragma once

#include <filesystem>
#include <string>

#include "shoal/core/setting.hpp"

namespace shoal::analysis {

// Of a path, or of a name that ships. Both throw InputError, which names the right command where
// the other kind of file is given.
std::filesystem::path scenario_file(const std::string& name_or_path);
std::filesystem::path study_file(const std::string& name_or_path);

/// Throws InputError if the file that reads like this is one of claims, which a study names.
void require_no_claims(const Setting& root, const std::filesystem::path& file);

}  // namespace shoal::analysis
