#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "shoal/analysis/corpus.hpp"
#include "shoal/formations/planner.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

/// Notes every situation in which a vehicle solved problems. The trial's numbers do not change.
class ProblemRecorder {
 public:
  /// For TrialSettings::plan_observer. One recorder serves one trial, and outlives it.
  std::function<formations::PlanObserver&(std::size_t vehicle)> of_trial();

  /// What was noted, vehicle by vehicle, in the order of time.
  Corpus corpus(const scenarios::Scenario& scenario, const std::string& name,
                const formations::Plan& plan) const;

 private:
  class OfVehicle final : public formations::PlanObserver {
   public:
    /// The situation is noted, and not the problem, which it states again.
    Wants wants() const override { return {.problems = false}; }
    void answered(const solvers::Answer&, double) override { solved_ = true; }
    void planned(const formations::Neighbourhood& seen, const formations::Target&) override;

    std::vector<Situation> noted;

   private:
    bool solved_ = false;  // a problem, since the last plan
  };

  std::deque<OfVehicle> vehicles_;  // stay where they are
};

}  // namespace shoal::analysis
