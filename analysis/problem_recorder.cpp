#include "shoal/analysis/problem_recorder.hpp"

namespace shoal::analysis {

void ProblemRecorder::OfVehicle::planned(const formations::Neighbourhood& seen,
                                         const formations::Target&) {
  if (!solved_) return;
  solved_ = false;
  noted.push_back({0, seen.own_slot, seen.own, {seen.neighbours.begin(), seen.neighbours.end()}});
}

std::function<formations::PlanObserver&(std::size_t)> ProblemRecorder::of_trial() {
  return [this](std::size_t) -> formations::PlanObserver& { return vehicles_.emplace_back(); };
}

Corpus ProblemRecorder::corpus(const scenarios::Scenario& scenario, const std::string& name,
                               const formations::Plan& plan) const {
  Corpus corpus;
  corpus.experiments.push_back(
      {name, scenario.behaviour.setting().write(Registry<formations::Behaviour>::instance()), plan,
       scenario.obstacles,
       scenario.waypoint ? std::optional(scenario.waypoint->place()) : std::nullopt});
  for (const OfVehicle& vehicle : vehicles_) {
    corpus.situations.insert(corpus.situations.end(), vehicle.noted.begin(), vehicle.noted.end());
  }
  return corpus;
}

}  // namespace shoal::analysis
