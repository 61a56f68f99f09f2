#include "shoal/analysis/experiments/sweep/open_sweep.hpp"

#include <unordered_map>
#include <unordered_set>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/store/folder_lock.hpp"
#include "shoal/analysis/experiments/store/manifest.hpp"
#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/analysis/experiments/study/needed_series.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/analysis/experiments/trial.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

/// Compares what a study asks for with what is stored.
class TrialsToRun {
 public:
  TrialsToRun(const TrialList& list, const Store& store, const SweepSettings& settings) {
    std::unordered_map<std::string, StoredTrial> stored;
    for (StoredTrial& trial : store.trials(std::vector<std::string>{})) {
      std::string key = trial.key;
      stored.emplace(std::move(key), std::move(trial));
    }
    const std::unordered_set<std::string> incomplete = lacking_series(list, store, stored);

    CellScenarios scenarios(list);
    std::size_t cell_group = list.groups().size(), cell = 0;
    std::string identity;
    for (const std::size_t i : list.part(settings.shard, settings.shards)) {
      const ListedTrial& trial = list.trial(i);
      if (trial.group != cell_group || trial.cell != cell) {
        cell_group = trial.group;
        cell = trial.cell;
        identity = scenarios.of(cell_group, cell).identity;
      }
      ++planned;
      const std::string key = list.groups()[trial.group].key(trial.cell, trial.replication);
      const std::string id = trial_identity(identity, list.seed(trial));
      const auto found = stored.find(key);
      const bool is_changed = found != stored.end() &&
                              (found->second.id != id || contradiction(list, trial, found->second));
      if (is_changed) {
        if (changed.empty()) why_changed = reason(list, trial, found->second);
        changed.push_back(key);
      }
      if (found == stored.end() || is_changed || incomplete.contains(key) ||
          (settings.retry_failed && found->second.failed())) {
        tasks.push_back({&trial, identity, id});
      } else {
        failed += found->second.failed() ? 1 : 0;
      }
    }
  }

  std::vector<SweepTask> tasks;
  std::vector<std::string> changed;  // keys of stored trials that would come out differently now
  std::string why_changed;
  std::size_t planned = 0, failed = 0;

 private:
  static std::unordered_set<std::string> lacking_series(
      const TrialList& list, const Store& store,
      const std::unordered_map<std::string, StoredTrial>& stored) {
    std::unordered_set<std::string> lacking;
    for (const std::string& name : needed_series(list.study())) {
      const std::vector<std::string> keys = store.keys_with_series(name);
      const std::unordered_set<std::string> having(keys.begin(), keys.end());
      for (const auto& [key, trial] : stored) {
        if (!trial.failed() && !having.contains(key)) lacking.insert(key);
      }
    }
    return lacking;
  }

  static std::string reason(const TrialList& list, const ListedTrial& trial,
                            const StoredTrial& stored) {
    const std::string& program = build_info().program;
    if (stored.program != program) {
      return "they were run by shoal " + stored.program + ", and this is " + program;
    }
    if (stored.seed != list.seed(trial)) return "the seeds of the study have changed";
    if (const auto wrong = contradiction(list, trial, stored)) {
      return "of the trial " + stored.key + " the stored " + *wrong;
    }
    return "the scenario of \"" + list.title(trial) + "\" has changed, or a file it names";
  }
};

const fs::path& writable(const fs::path& folder) {
  require_writable(folder);
  return folder;
}

}  // namespace

struct OpenSweep::State {
  State(const TrialList& study, const fs::path& folder, const SweepSettings& settings)
      : list(study),
        lock(writable(folder)),
        manifest(list, folder),
        store(folder, Store::Access::write),
        missing(list, store, settings),
        series(needed_series(list.study())) {
    if (!missing.changed.empty()) {
      if (!settings.rerun_changed) {
        throw InputError(
            std::to_string(missing.changed.size()) + " of the trials stored in " + folder.string() +
            " would come out differently now: " + missing.why_changed +
            "; choose another folder with --out, or give --rerun-changed to run them again");
      }
      store.erase(missing.changed);
    }
    write_study(list, folder);
    manifest.begin_sweep(settings);
    progress.planned = missing.planned;
    progress.stored = missing.planned - missing.tasks.size();
    progress.failed = missing.failed;
  }

  const TrialList& list;
  FolderLock lock;
  Manifest manifest;
  Store store;
  TrialsToRun missing;
  std::vector<std::string> series;
  SweepProgress progress;
};

OpenSweep::OpenSweep(const TrialList& list, const fs::path& folder, const SweepSettings& settings)
    : state_(std::make_unique<State>(list, folder, settings)) {}

OpenSweep::~OpenSweep() = default;

const std::vector<SweepTask>& OpenSweep::tasks() const {
  return state_->missing.tasks;
}

const std::vector<std::string>& OpenSweep::series() const {
  return state_->series;
}

const SweepProgress& OpenSweep::progress() const {
  return state_->progress;
}

void OpenSweep::store(const SweepTask& task, TrialOutcome outcome) {
  const TrialList& list = state_->list;
  const ListedTrial& planned = *task.trial;
  StoredTrial trial = planned_trial(list, planned);
  trial.scenario = task.scenario;
  trial.id = task.id;
  trial.program = build_info().program;
  trial.failure = std::move(outcome.failure);
  trial.wall_s = outcome.wall_s;
  trial.measures = std::move(outcome.measures);
  trial.series = std::move(outcome.series);
  state_->store.write(trial);
  SweepProgress& progress = state_->progress;
  ++progress.done;
  if (trial.failed() && ++progress.failed == 1) {
    progress.first_failure = list.title(planned) + ": " + trial.failure;
  }
}

void OpenSweep::end(double elapsed_s) {
  state_->progress.elapsed_s = elapsed_s;
  state_->manifest.end_sweep(state_->progress);
}

}  // namespace shoal::analysis
