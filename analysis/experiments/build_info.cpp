#include "shoal/analysis/experiments/build_info.hpp"

#include <algorithm>

#include "shoal/core/text.hpp"
#include "source_id.inc"

namespace shoal::analysis {
namespace {

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

/// "Eigen 3.4.0|Boost 1.74.0": as CMake found them.
std::vector<std::pair<std::string, std::string>> libraries() {
  std::vector<std::pair<std::string, std::string>> found;
  for (const std::string_view entry : split(SHOAL_BUILT_WITH, '|')) {
    const auto space = entry.find(' ');
    found.emplace_back(entry.substr(0, space), entry.substr(space + 1));
  }
  return found;
}

BuildInfo& known() {
  static BuildInfo info{SHOAL_VERSION, std::string(SHOAL_VERSION) + "-" + source_hash,
                        source_commit, source_dirty,
                        compiler(),    libraries()};
  return info;
}

}  // namespace

const BuildInfo& build_info() {
  return known();
}

void make_part_of_program(const std::string& key, const std::string& plugin) {
  static const std::string shoal_alone = known().program;
  static std::vector<std::pair<std::string, std::string>> parts;
  const auto same = [&](const auto& part) { return part.first == key; };
  const auto found = std::ranges::find_if(parts, same);
  if (found != parts.end()) {
    found->second = plugin;
  } else {
    parts.emplace_back(key, plugin);
  }
  known().program = shoal_alone;
  for (const auto& part : parts) known().program += "+" + part.second;
}

}  // namespace shoal::analysis
