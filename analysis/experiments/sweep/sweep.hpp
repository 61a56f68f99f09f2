#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

struct SweepProgress {
  std::size_t planned = 0;  ///< trials of this shard
  std::size_t stored = 0;   ///< of them, that were there before
  std::size_t done = 0;     ///< run by this sweep, with those that failed
  std::size_t failed = 0;   ///< of all that are stored now
  double elapsed_s = 0.0;
  std::string first_failure;  ///< which trial, and why
};

struct SweepSettings {
  int jobs = 1;
  int shard = 1, shards = 1;
  bool fail_fast = false;      ///< no new trial is begun after the first that fails
  bool rerun_changed = false;  ///< run again what a changed study, scenario or program would change
  bool retry_failed = false;
  /// A shoal program, for trials that need processes of their own; "" runs them in this one, one
  /// after the other.
  std::string worker_program;
  /// Called by this thread a few times a second, and once at the end.
  std::function<void(const SweepProgress&)> progress;
};

/// Runs the trials of a study that a folder does not hold yet, in `jobs` threads, and stores each
/// as it ends. What is stored does not depend on the number of jobs, nor on how often the sweep was
/// killed and run again.
///
/// Writes study.toml (resolved), claims.toml, manifest.json and trials.sqlite. Throws InputError
/// before anything runs if a cell cannot be run, or if stored trials come from another version of
/// study, scenario or program and `rerun_changed` is not set; SystemError if the folder is in use
/// or cannot be written.
SweepProgress sweep(const TrialList& list, const std::filesystem::path& folder,
                    const SweepSettings& settings);

}  // namespace shoal::analysis
