#include "shoal/analysis/experiments/plugins.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/plugin.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_plugin_bytes = 1'000'000'000;  // with debugging symbols
constexpr char variable[] = "SHOAL_PLUGINS";
// In two parts, so that this library does not look like a plugin itself.
const std::string mark = std::string("shoal plugin, ") + "ABI ";

std::vector<Plugin>& loaded() {
  static std::vector<Plugin> plugins;
  return plugins;
}

void require_abi(const fs::path& file, const std::string& content) {
  const auto begin = content.find(mark);
  if (begin == std::string::npos) {
    throw InputError(file.string() +
                     " is no plugin of shoal; put SHOAL_PLUGIN (shoal/core/plugin.hpp) into one of "
                     "its sources");
  }
  const std::string abi =
      content.substr(begin + mark.size(), content.find(';', begin) - begin - mark.size());
  if (abi == SHOAL_ABI) return;
  throw InputError(file.string() + " was built for shoal " + abi + ", and this is " SHOAL_ABI +
                   "; build it anew against this one");
}

}  // namespace

void load_plugin(const fs::path& given) {
  const fs::path file = fs::absolute(given).lexically_normal();
  const auto same = [&](const Plugin& plugin) { return plugin.file == file; };
  if (std::ranges::any_of(loaded(), same)) return;
  if (file.string().find(':') != std::string::npos) {
    throw InputError("the plugin " + file.string() +
                     " has a colon in its path, which separates those of SHOAL_PLUGINS; move it");
  }
  const auto content = read_whole_file(file, most_plugin_bytes);
  if (!content) throw InputError("cannot read the plugin " + file.string());
  require_abi(file, *content);
  const RegistryWatch watch;
  // Global, so that one plugin may build on another.
  const bool there = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL) != nullptr;
  const std::string why = there ? watch.failure() : ::dlerror();
  if (!why.empty()) {
    throw InputError("cannot load the plugin " + file.string() + ": " + why);
  }
  loaded().push_back({file, hash_of(*content)});
  make_part_of_program(file.string(), file.filename().string() + "-" + loaded().back().hash);
  std::string all;
  for (const Plugin& plugin : loaded()) all += (all.empty() ? "" : ":") + plugin.file.string();
  ::setenv(variable, all.c_str(), 1);
}

void load_plugins_of_environment() {
  const char* given = std::getenv(variable);
  if (!given) return;
  const std::string files = given;  // which loading changes
  for (const std::string_view file : split(files, ':')) {
    if (!file.empty()) load_plugin(file);
  }
}

const std::vector<Plugin>& loaded_plugins() {
  return loaded();
}

}  // namespace shoal::analysis
