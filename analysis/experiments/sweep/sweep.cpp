#include "shoal/analysis/experiments/sweep/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/analysis/experiments/sweep/open_sweep.hpp"
#include "shoal/analysis/experiments/trial.hpp"

namespace shoal::analysis {
namespace {

using Clock = std::chrono::steady_clock;

/// Ends a trial that is no longer wanted. It is no failure, and so no std::exception.
struct Cancelled {};

class CancelWatch final : public scenarios::Observer {
 public:
  CancelWatch(const scenarios::Scenario& scenario, const std::atomic<bool>& cancelled)
      : every_s_(watching_interval_s(scenario)), cancelled_(cancelled) {}

  double every_s() const override { return every_s_; }
  void observe(const scenarios::World&) override {
    if (cancelled_) throw Cancelled{};
  }

 private:
  double every_s_;
  const std::atomic<bool>& cancelled_;
};

/// Runs tasks in threads and stores what they leave.
class Crew {
 public:
  Crew(const TrialList& list, OpenSweep& sweep, const SweepSettings& settings)
      : list_(list), sweep_(sweep), settings_(settings) {}

  void run() {
    const auto jobs = std::min(static_cast<std::size_t>(settings_.jobs), sweep_.tasks().size());
    {
      std::vector<std::jthread> threads;
      running_ = jobs;
      for (std::size_t j = 0; j < jobs; ++j) threads.emplace_back([this] { work(); });
      try {
        report_until_done();
      } catch (...) {  // the progress callback wants no more of it
        stop_ = cancelled_ = true;
        throw;
      }
    }
    if (broken_) std::rethrow_exception(broken_);
  }

  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

 private:
  void report_until_done() {
    std::unique_lock lock(mutex_);
    while (true) {
      idle_.wait_for(lock, std::chrono::milliseconds(200), [this] { return running_ == 0; });
      SweepProgress now = sweep_.progress();
      now.elapsed_s = elapsed_s();
      const bool over = running_ == 0;
      lock.unlock();
      if (settings_.progress) settings_.progress(now);
      if (over) return;
      lock.lock();
    }
  }

  void work() {
    CellScenarios scenarios(list_);
    try {
      while (!stop_) {
        const std::size_t next = next_++;
        if (next >= sweep_.tasks().size()) break;
        const SweepTask& task = sweep_.tasks()[next];
        TrialOutcome outcome = outcome_of(task, scenarios);
        const bool failed = !outcome.failure.empty();
        const std::lock_guard lock(mutex_);
        sweep_.store(task, std::move(outcome));
        if (failed && settings_.fail_fast) stop_ = true;
      }
    } catch (const Cancelled&) {  // the trial is run by the next sweep
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!broken_) broken_ = std::current_exception();
      stop_ = true;
    }
    const std::lock_guard lock(mutex_);
    --running_;
    idle_.notify_one();
  }

  TrialOutcome outcome_of(const SweepTask& task, CellScenarios& scenarios) const {
    const CellScenario cell = scenarios.of(*task.trial);
    if (cell.one_at_a_time && settings_.jobs > 1 && !settings_.worker_program.empty()) {
      return trial_outcome_of_worker(settings_.worker_program, cell.scenario, sweep_.series());
    }
    CancelWatch watch(cell.scenario, cancelled_);
    return trial_outcome(cell.scenario, sweep_.series(), &watch);
  }

  const TrialList& list_;
  OpenSweep& sweep_;
  const SweepSettings& settings_;
  const Clock::time_point began_ = Clock::now();

  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;       // no new trial
  std::atomic<bool> cancelled_ = false;  // nor the end of those that run
  std::mutex mutex_;                     // of the sweep, and of what follows
  std::condition_variable idle_;
  std::size_t running_ = 0;
  std::exception_ptr broken_;
};

}  // namespace

SweepProgress sweep(const TrialList& list, const std::filesystem::path& folder,
                    const SweepSettings& settings) {
  OpenSweep open(list, folder, settings);
  Crew crew(list, open, settings);
  crew.run();
  open.end(crew.elapsed_s());
  return open.progress();
}

}  // namespace shoal::analysis
