#include "shoal/scenarios/library_path.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;

/// The folder of the shared library (or program) that holds this very function.
fs::path own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0 || !info.dli_fname) {
    throw SystemError("cannot tell where shoal is installed; set SHOAL_LIBRARY to its library");
  }
  return fs::canonical(info.dli_fname).parent_path();
}

constexpr const char* sets_folder = "sets";

/// Of the TOML files in a folder, sorted.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

fs::path library_path() {
  if (const char* given = std::getenv("SHOAL_LIBRARY"); given && *given) {
    std::error_code ignored;
    if (fs::is_directory(given, ignored)) return given;
    throw InputError("SHOAL_LIBRARY is " + std::string(given) + ", which is no folder");
  }
  // Found once: a relative name of the library means something only where the program started.
  static const fs::path here = own_folder();
  // lib/ as built, lib/<architecture>/ as Debian installs.
  for (const char* up : {"..", "../.."}) {
    const fs::path candidate = (here / up / "share/shoal/library").lexically_normal();
    std::error_code ignored;
    if (fs::is_directory(candidate, ignored)) return candidate;
  }
  throw SystemError("no library of scenarios at " +
                    (here / "../share/shoal/library").lexically_normal().string() +
                    "; set SHOAL_LIBRARY to its folder");
}

fs::path resolved(const FilePath& file) {
  static constexpr std::string_view scheme = "library:";
  const std::string text = file.path.string();
  if (text.empty()) throw InputError(file.origin, "no file is named where one is needed");
  const bool from_library = text.starts_with(scheme);
  const fs::path path = from_library ? library_path() / text.substr(scheme.size()) : file.path;
  std::error_code ignored;  // a folder that may not be read holds no file for us
  if (!fs::exists(path, ignored)) {
    throw InputError(file.origin, "there is no file " + path.string() +
                                      (from_library ? ", which " + text + " stands for" : ""));
  }
  if (fs::is_directory(path, ignored)) {
    throw InputError(file.origin, path.string() + " is a folder; name a file in it");
  }
  return path;
}

std::vector<std::string> library_scenarios() {
  return names_in(library_path());
}

std::vector<std::string> library_sets() {
  const fs::path folder = library_path() / sets_folder;
  std::error_code ignored;  // a library of your own may have none
  return fs::is_directory(folder, ignored) ? names_in(folder) : std::vector<std::string>{};
}

fs::path set_file(const std::string& name) {
  return library_path() / sets_folder / (name + ".toml");
}

}  // namespace shoal::scenarios
