#include "shoal/analysis/study/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <unordered_map>
#include <unordered_set>

#include "shoal/analysis/build_info.hpp"
#include "shoal/analysis/study/cell_scenarios.hpp"
#include "shoal/analysis/study/folder_lock.hpp"
#include "shoal/analysis/study/manifest.hpp"
#include "shoal/analysis/study/needed_series.hpp"
#include "shoal/analysis/study/store.hpp"
#include "shoal/analysis/study/study_files.hpp"
#include "shoal/analysis/study/trial_outcome.hpp"
#include "shoal/analysis/trial.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// One trial that is to run.
struct Task {
  const PlannedTrial* trial;
  std::string scenario;  // CellScenario::identity
  std::string id;
};

/// Compares what a study asks for with what is stored.
class Missing {
 public:
  Missing(const StudyPlan& plan, const Store& store, const SweepSettings& settings) {
    std::unordered_map<std::string, StoredTrial> stored;
    for (StoredTrial& trial : store.trials(std::vector<std::string>{})) {
      std::string key = trial.key;
      stored.emplace(std::move(key), std::move(trial));
    }
    const std::unordered_set<std::string> incomplete = lacking_series(plan, store, stored);

    CellScenarios scenarios(plan);
    std::size_t cell_group = plan.groups().size(), cell = 0;
    std::string identity;
    for (const std::size_t i : plan.part(settings.shard, settings.shards)) {
      const PlannedTrial& trial = plan.trial(i);
      if (trial.group != cell_group || trial.cell != cell) {
        cell_group = trial.group;
        cell = trial.cell;
        identity = scenarios.of(cell_group, cell).identity;
      }
      ++planned;
      const std::string key = plan.groups()[trial.group].key(trial.cell, trial.replication);
      const std::string id = trial_identity(identity, plan.seed(trial));
      const auto found = stored.find(key);
      const bool is_changed = found != stored.end() && found->second.id != id;
      if (is_changed) {
        if (changed.empty()) why_changed = reason(plan, trial, found->second);
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

  std::vector<Task> tasks;
  std::vector<std::string> changed;  // keys of stored trials that would come out differently now
  std::string why_changed;
  std::size_t planned = 0, failed = 0;

 private:
  static std::unordered_set<std::string> lacking_series(
      const StudyPlan& plan, const Store& store,
      const std::unordered_map<std::string, StoredTrial>& stored) {
    std::unordered_set<std::string> lacking;
    for (const std::string& name : needed_series(plan.study())) {
      const std::vector<std::string> keys = store.keys_with_series(name);
      const std::unordered_set<std::string> having(keys.begin(), keys.end());
      for (const auto& [key, trial] : stored) {
        if (!trial.failed() && !having.contains(key)) lacking.insert(key);
      }
    }
    return lacking;
  }

  static std::string reason(const StudyPlan& plan, const PlannedTrial& trial,
                            const StoredTrial& stored) {
    const std::string& program = build_info().program;
    if (stored.program != program) {
      return "they were run by shoal " + stored.program + ", and this is " + program;
    }
    if (stored.seed != plan.seed(trial)) return "the seeds of the study have changed";
    return "the scenario of \"" + plan.title(trial) + "\" has changed, or a file it names";
  }
};

/// Runs tasks in threads and stores what they leave.
class Crew {
 public:
  Crew(const StudyPlan& plan, Store& store, const std::vector<Task>& tasks,
       const SweepSettings& settings, SweepProgress progress)
      : plan_(plan),
        store_(store),
        tasks_(tasks),
        settings_(settings),
        series_(needed_series(plan.study())),
        progress_(std::move(progress)) {}

  SweepProgress run() {
    const auto jobs = std::min(static_cast<std::size_t>(settings_.jobs), tasks_.size());
    {
      std::vector<std::jthread> threads;
      running_ = jobs;
      for (std::size_t j = 0; j < jobs; ++j) threads.emplace_back([this] { work(); });
      report_until_done();
    }
    if (broken_) std::rethrow_exception(broken_);
    return progress_;
  }

 private:
  void report_until_done() {
    std::unique_lock lock(mutex_);
    while (true) {
      idle_.wait_for(lock, std::chrono::milliseconds(200), [this] { return running_ == 0; });
      progress_.elapsed_s = std::chrono::duration<double>(Clock::now() - began_).count();
      const SweepProgress now = progress_;
      const bool over = running_ == 0;
      lock.unlock();
      if (settings_.progress) settings_.progress(now);
      if (over) return;
      lock.lock();
    }
  }

  void work() {
    CellScenarios scenarios(plan_);
    try {
      while (!stop_) {
        const std::size_t next = next_++;
        if (next >= tasks_.size()) break;
        store_outcome(tasks_[next], outcome_of(tasks_[next], scenarios));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!broken_) broken_ = std::current_exception();
      stop_ = true;
    }
    const std::lock_guard lock(mutex_);
    --running_;
    idle_.notify_one();
  }

  TrialOutcome outcome_of(const Task& task, CellScenarios& scenarios) const {
    CellScenario cell = scenarios.of(task.trial->group, task.trial->cell);
    cell.scenario.trial.seed = plan_.seed(*task.trial);
    if (cell.one_at_a_time && settings_.jobs > 1 && !settings_.worker_program.empty()) {
      return trial_outcome_of_worker(settings_.worker_program, cell.scenario, series_);
    }
    return trial_outcome(cell.scenario, series_);
  }

  void store_outcome(const Task& task, TrialOutcome outcome) {
    const PlannedTrial& planned = *task.trial;
    const PlannedGroup& group = plan_.groups()[planned.group];
    StoredTrial trial{.key = group.key(planned.cell, planned.replication),
                      .group = group.name(),
                      .factors = {},
                      .replication = planned.replication,
                      .seed = plan_.seed(planned),
                      .scenario = task.scenario,
                      .id = task.id,
                      .program = build_info().program,
                      .failure = std::move(outcome.failure),
                      .wall_s = outcome.wall_s,
                      .metrics = std::move(outcome.metrics),
                      .series = std::move(outcome.series)};
    for (std::size_t i = 0; i < group.columns().size(); ++i) {
      trial.factors.emplace_back(group.columns()[i], group.labels(planned.cell)[i]);
    }
    const std::lock_guard lock(mutex_);
    store_.write(trial);
    ++progress_.done;
    if (!trial.failed()) return;
    if (++progress_.failed == 1)
      progress_.first_failure = plan_.title(planned) + ": " + trial.failure;
    if (settings_.fail_fast) stop_ = true;
  }

  const StudyPlan& plan_;
  Store& store_;
  const std::vector<Task>& tasks_;
  const SweepSettings& settings_;
  const std::vector<std::string> series_;
  const Clock::time_point began_ = Clock::now();

  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;  // of the store, and of what follows
  std::condition_variable idle_;
  std::size_t running_ = 0;
  SweepProgress progress_;
  std::exception_ptr broken_;
};

}  // namespace

SweepProgress sweep(const StudyPlan& plan, const fs::path& folder, const SweepSettings& settings) {
  require_writable(folder);
  const FolderLock lock(folder);
  Store store(folder, Store::Access::write);
  const Missing missing(plan, store, settings);
  if (!missing.changed.empty()) {
    if (!settings.rerun_changed) {
      throw InputError(
          std::to_string(missing.changed.size()) + " of the trials stored in " + folder.string() +
          " would come out differently now: " + missing.why_changed +
          "; choose another folder with --out, or give --rerun-changed to run them again");
    }
    store.erase(missing.changed);
  }
  write_study(plan, folder);
  Manifest manifest(plan, folder);
  manifest.begin_sweep(settings);

  SweepProgress progress;
  progress.planned = missing.planned;
  progress.stored = missing.planned - missing.tasks.size();
  progress.failed = missing.failed;
  progress = Crew(plan, store, missing.tasks, settings, progress).run();
  manifest.end_sweep(progress);
  return progress;
}

}  // namespace shoal::analysis
