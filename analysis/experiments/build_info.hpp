#pragma once

#include <string>
#include <utility>
#include <vector>

namespace shoal::analysis {

/// How this program came to be, for manifests.
struct BuildInfo {
  std::string version;
  /// Version and hash of all sources that numbers of trials depend on, and those of plugins.
  std::string program;
  std::string commit;  ///< of the source tree; "unknown" outside a repository
  bool dirty = false;  ///< whether files differed from that commit when it was built
  std::string compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
};

const BuildInfo& build_info();

/// Makes a plugin part of `program`, on which all trials depend; in place of an earlier one that
/// was given under the same key.
void make_part_of_program(const std::string& key, const std::string& plugin);

}  // namespace shoal::analysis
