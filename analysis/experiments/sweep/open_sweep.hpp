#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/store/trial_outcome.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/analysis/experiments/sweep/sweep.hpp"

namespace shoal::analysis {

/// One trial that a sweep is to run.
struct SweepTask {
  const ListedTrial* trial;
  std::string scenario;  ///< CellScenario::identity
  std::string id;        ///< trial_identity()
};

/// The folder of a study while a sweep works on it: which trials it lacks, and where their outcomes
/// go, wherever they run. Not for several threads at a time.
class OpenSweep {
 public:
  /// Locks the folder and writes what stands in it besides trials. Throws as sweep() says. The list
  /// must outlive it.
  OpenSweep(const TrialList& list, const std::filesystem::path& folder,
            const SweepSettings& settings);
  ~OpenSweep();

  const std::vector<SweepTask>& tasks() const;
  /// Series that outcomes must hold.
  const std::vector<std::string>& series() const;

  /// Stores what became of a task, and counts it. Throws SystemError.
  void store(const SweepTask& task, TrialOutcome outcome);
  const SweepProgress& progress() const;

  /// Notes in the manifest that all is done. A sweep that is cut short never says so.
  void end(double elapsed_s);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shoal::analysis
