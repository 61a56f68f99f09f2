#include "shoal/analysis/benchmarking/problem_recorder.hpp"

namespace shoal::analysis {

void ProblemRecorder::OfVehicle::planned(const formations::Neighbourhood& seen,
                                         const formations::Target&) {
  if (!solved_) return;
  solved_ = false;
  const std::size_t k = situations_++;
  if (k != next_) return;
  next_ += stride_;
  if (kept_.size() == most_) {
    kept_.keep_every_second();
    stride_ *= 2;
    if (k % stride_ != 0) return;
    next_ = k + stride_;
  }
  kept_.add(seen);
}

std::function<formations::PlanObserver&(std::size_t)> ProblemRecorder::of_trial() {
  return [this](std::size_t) -> formations::PlanObserver& {
    return vehicles_.emplace_back(most_, blocks_);
  };
}

Corpus ProblemRecorder::corpus(const scenarios::Scenario& scenario, const std::string& name,
                               const formations::Plan& plan) const {
  Corpus corpus;
  corpus.experiments.push_back(
      {name, scenario.behaviour.setting().write(Registry<formations::Behaviour>::instance()), plan,
       scenario.obstacles,
       scenario.waypoint ? std::optional(scenario.waypoint->place()) : std::nullopt});
  for (const OfVehicle& vehicle : vehicles_) {
    const PackedSituations& kept = vehicle.kept();
    for (std::size_t k = 0; k < kept.size(); ++k) corpus.situations.push_back(kept[k]);
  }
  return corpus;
}

std::size_t ProblemRecorder::situations() const {
  std::size_t sum = 0;
  for (const OfVehicle& vehicle : vehicles_) sum += vehicle.situations();
  return sum;
}

}  // namespace shoal::analysis
