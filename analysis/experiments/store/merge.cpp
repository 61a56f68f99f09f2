#include "shoal/analysis/experiments/store/merge.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "shoal/analysis/experiments/store/folder_lock.hpp"
#include "shoal/analysis/experiments/store/manifest.hpp"
#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/store/stored_union.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

bool holds_a_study(const fs::path& folder) {
  return fs::exists(folder / "study.toml");
}

/// The folders that are not `folder`, each once.
std::vector<fs::path> distinct(const fs::path& folder, const std::vector<fs::path>& others) {
  std::vector<fs::path> found;
  for (const fs::path& other : others) {
    if (!fs::exists(other / "trials.sqlite") || !holds_a_study(other)) {
      throw InputError(other.string() +
                       " holds no trials of a study; name folders that shoal sweep wrote");
    }
    const auto is_other = [&](const fs::path& known) {
      return fs::exists(known) && fs::equivalent(known, other);
    };
    if (!is_other(folder) && std::ranges::none_of(found, is_other)) found.push_back(other);
  }
  return found;
}

/// Takes away what a merge made in a folder that held no study, unless it is to be kept.
class Undo {
 public:
  explicit Undo(const fs::path& folder) : folder_(folder), made_(!fs::exists(folder)) {
    if (holds_a_study(folder)) return;
    for (const char* name :
         {"study.toml", "claims.toml", "manifest.json", "trials.sqlite", "trials.sqlite-wal",
          "trials.sqlite-shm", "trials.sqlite-journal", ".lock"}) {
      if (!fs::exists(folder / name)) new_.push_back(folder / name);
    }
  }
  ~Undo() {
    std::error_code ignored;
    for (const fs::path& file : new_) fs::remove(file, ignored);
    if (made_) fs::remove(folder_, ignored);  // only if it is empty
  }
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

  void keep() {
    new_.clear();
    made_ = false;
  }

 private:
  fs::path folder_;
  bool made_;
  std::vector<fs::path> new_;
};

/// The lines of a TOML file without its comments; none if there is no such file.
std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  if (!fs::exists(file)) return lines;
  const std::string text = to_toml(scenarios::read_toml(file));
  for (const std::string_view line : split(text, '\n')) lines.emplace_back(line);
  return lines;
}

void require_same_study(const fs::path& one, const fs::path& other) {
  for (const char* name : {"study.toml", "claims.toml"}) {
    const std::vector<std::string> a = lines_of(one / name), b = lines_of(other / name);
    const auto [in_a, in_b] = std::ranges::mismatch(a, b);
    if (in_a == a.end() && in_b == b.end()) continue;
    const auto shown = [](const auto& line, const auto& lines) {
      return line == lines.end() ? std::string("nothing more") : "\"" + *line + '"';
    };
    throw InputError(one.string() + " and " + other.string() + " hold different studies: " + name +
                     " says " + shown(in_a, a) + " in the first, and " + shown(in_b, b) +
                     " in the second; merge parts of one study");
  }
}

/// A manifest that tells of a merge is older than the trials by a moment: this takes it back if
/// they are not stored after all.
class ManifestBefore {
 public:
  explicit ManifestBefore(const fs::path& folder)
      : file_(folder / "manifest.json"), text_(read_whole_file(file_).value_or("")) {}

  void restore() const noexcept {
    try {
      if (!text_.empty()) write_whole_file(file_, text_);
    } catch (const SystemError&) {
      // What went wrong before is the error to report; the manifest then names sweeps too many.
    }
  }

 private:
  fs::path file_;
  std::string text_;
};

}  // namespace

Merged merge(const fs::path& folder, const std::vector<fs::path>& others) {
  const std::vector<fs::path> sources = distinct(folder, others);
  std::deque<FolderLock> locks;
  for (const fs::path& source : sources) locks.emplace_back(source, FolderLock::Purpose::read);
  const fs::path& first = holds_a_study(folder) || sources.empty() ? folder : sources.front();
  for (const fs::path& source : sources) require_same_study(first, source);

  Undo undo(folder);
  require_writable(folder, "choose another folder");
  const FolderLock lock(folder);
  Store store(folder, Store::Access::write);
  if (!holds_a_study(folder)) {
    if (!store.trials(std::vector<std::string>{}).empty()) {
      throw InputError(folder.string() +
                       " holds trials, but no study.toml that says of which study; merge into "
                       "another folder");
    }
    for (const char* name : {"claims.toml", "study.toml"}) {
      if (fs::exists(first / name))
        write_whole_file(folder / name, read_whole_file(first / name).value());
    }
  }

  Merged merged{.list = stored_list(folder), .folders = {}};
  StoredUnion all(merged.list, store, folder);
  Manifest manifest(merged.list, folder);
  const ManifestBefore before(folder);
  try {
    store.together([&] {
      merged.folders.push_back(all.own());
      for (const fs::path& source : sources) {
        merged.folders.push_back(all.add(source));
        manifest.take_history(source);
      }
      manifest.end_merge(merged.folders);
    });
  } catch (...) {
    before.restore();
    throw;
  }
  undo.keep();
  merged.stored = all.stored();
  merged.failed = all.failed();
  return merged;
}

}  // namespace shoal::analysis
