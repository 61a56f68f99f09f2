#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "shoal/analysis/experiments/store/merge.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/analysis/experiments/sweep/sweep.hpp"

namespace shoal::analysis {

/// manifest.json: the study, its seeds, the program, and every sweep and merge that worked on the
/// folder, each with its host, its program and its times. study.toml must stand there before.
class Manifest {
 public:
  Manifest(const TrialList& list, const std::filesystem::path& folder);
  ~Manifest();

  /// Each writes the file. Throws SystemError.
  void begin_sweep(const SweepSettings& settings);
  void end_sweep(const SweepProgress& progress);
  void end_merge(const std::vector<MergedFolder>& folders);

  /// Adds what other folders tell of their sweeps and merges. Throws InputError if there is no
  /// manifest, or if it cannot be read.
  void take_history(const std::filesystem::path& other);

 private:
  struct Content;
  void write() const;

  const TrialList& list_;
  std::filesystem::path folder_;
  std::unique_ptr<Content> content_;
};

}  // namespace shoal::analysis
