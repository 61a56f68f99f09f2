#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shoal/analysis/corpus.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::analysis {

/// Stands between a swarm and its behaviour and notes every situation in which problems are posed.
/// The trial's numbers do not change.
class ProblemRecorder {
 public:
  ProblemRecorder();

  /// For TrialSettings::behaviour_hook. One recorder serves one trial.
  scenarios::BehaviourHook hook();

  /// What was noted, vehicle by vehicle, in the order of time.
  Corpus corpus(const scenarios::Scenario& scenario, const std::string& name,
                const formations::Plan& plan) const;

  /// Written by several threads, each for vehicles of its own.
  using BySlot = std::vector<std::vector<Situation>>;

 private:
  std::shared_ptr<BySlot> noted_;
};

}  // namespace shoal::analysis
