#include "shoal/analysis/experiments/store/trial_outcome.hpp"

#include <algorithm>
#include <chrono>
#include <new>

#include "shoal/analysis/experiments/trial.hpp"

namespace shoal::analysis {

TrialOutcome trial_outcome(const scenarios::Scenario& scenario,
                           const std::vector<std::string>& series, scenarios::Observer* observer) {
  TrialOutcome outcome;
  const auto began = std::chrono::steady_clock::now();
  try {
    TrialSettings settings{.record = false};
    if (observer) settings.observers.push_back(observer);
    Trial trial = run_trial(scenario, settings);
    outcome.measures = std::move(trial.results.values);
    for (scenarios::Series& each : trial.results.series) {
      if (std::ranges::find(series, each.name) != series.end()) {
        outcome.series.push_back(std::move(each));
      }
    }
  } catch (const std::bad_alloc&) {
    outcome.failure = "there is not enough memory";
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return outcome;
}

}  // namespace shoal::analysis
