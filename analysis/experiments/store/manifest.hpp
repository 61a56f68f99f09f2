#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "shoal/analysis/experiments/store/merge.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/analysis/experiments/sweep/sweep.hpp"

namespace shoal::analysis {

/// What manifest.json of a folder holds, with a list `sweeps` of objects that have a text `began`,
/// and perhaps a list `merges` of such; null if there is no such file. Throws InputError if the
/// file cannot be read, or holds something else.
nlohmann::ordered_json stored_manifest(const std::filesystem::path& folder);

/// manifest.json: the study, its seeds, the program, and every sweep and merge that worked on the
/// folder, each with its host, its program and its times.
class Manifest {
 public:
  /// Goes on with the manifest that is there. Throws InputError as stored_manifest() does.
  Manifest(const TrialList& list, const std::filesystem::path& folder);
  ~Manifest();

  /// Each writes the file; study.toml must stand there before. Throws SystemError.
  void begin_sweep(const SweepSettings& settings);
  void end_sweep(const SweepProgress& progress);
  void end_merge(const std::vector<MergedFolder>& folders);

  /// Adds what other folders tell of their sweeps and merges. Throws InputError if there is no
  /// manifest, and as stored_manifest() does.
  void take_history(const std::filesystem::path& other);

 private:
  struct Content;
  void write() const;

  const TrialList& list_;
  std::filesystem::path folder_;
  std::unique_ptr<Content> content_;
};

}  // namespace shoal::analysis
