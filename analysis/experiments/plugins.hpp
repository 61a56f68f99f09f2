#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal::analysis {

/// A shared library with members of families, and what stands in it.
struct Plugin {
  std::filesystem::path file;  ///< absolute
  std::string hash;            ///< of the file
};

/// Loads a plugin, whose members are then known like any others; loading it again does nothing.
/// Trials depend on it: its name and hash become part of BuildInfo::program, and the environment
/// variable SHOAL_PLUGINS hands it to processes that this one starts.
///
/// Throws InputError if the file is no plugin, was built for another shoal, or cannot be loaded. To
/// be called before anything else asks what members there are, and by one thread.
void load_plugin(const std::filesystem::path& file);

/// Loads those that SHOAL_PLUGINS names, with colons between them.
void load_plugins_of_environment();

const std::vector<Plugin>& loaded_plugins();

}  // namespace shoal::analysis
