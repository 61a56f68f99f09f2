#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/series.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::analysis {

/// What a trial of a study leaves behind.
struct TrialOutcome {
  std::string failure;  ///< why it failed; "" if it did not
  double wall_s = 0.0;
  std::vector<std::pair<std::string, std::optional<double>>> measures;
  std::vector<scenarios::Series> series;
};

/// Runs a scenario in this thread and keeps its measures, and the series of these names. What goes
/// wrong is part of the outcome, except for what the observer throws that is no std::exception.
TrialOutcome trial_outcome(const scenarios::Scenario& scenario,
                           const std::vector<std::string>& series,
                           scenarios::Observer* observer = nullptr);

/// The same in a process of its own, for solvers that do not run in several threads of one process.
/// `program` is a shoal: it is called with `trial-worker`. Throws SystemError if it cannot be run.
TrialOutcome trial_outcome_of_worker(const std::string& program,
                                     const scenarios::Scenario& scenario,
                                     const std::vector<std::string>& series);

// A trial that another process runs, perhaps on another machine: what it is asked and what it
// answers, as texts.

std::string trial_request(const scenarios::Scenario& scenario,
                          const std::vector<std::string>& series);

/// Runs what is asked. Throws InputError if the request comes from another version of shoal: the
/// numbers could differ.
std::string trial_answer(const std::string& request);

/// Throws SystemError if it is none.
TrialOutcome parsed_answer(const std::string& answer);

/// The other end of trial_outcome_of_worker(): reads a request from stdin and writes its answer to
/// stdout.
void serve_as_worker();

}  // namespace shoal::analysis
