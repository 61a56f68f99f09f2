#include "shoal/analysis/benchmarking/problem_recorder.hpp"

namespace shoal::analysis {

void ProblemRecorder::OfVehicle::planned(const formations::Neighbourhood& seen,
                                         const formations::Target&) {
  if (!solved_) return;
  solved_ = false;
  const std::size_t k = situations_++;
  if (k != next_) return;
  next_ += stride_;
  if (kept_ == most_) {
    keep_every_second();
    if (k % stride_ != 0) return;
    next_ = k + stride_;
  }
  if (kept_ == noted_.size()) noted_.emplace_back();
  Situation& situation = noted_[kept_++];
  situation.own_slot = seen.own_slot;
  situation.own = seen.own;
  situation.neighbours.assign(seen.neighbours.begin(), seen.neighbours.end());
}

void ProblemRecorder::OfVehicle::keep_every_second() {
  kept_ = (kept_ + 1) / 2;
  for (std::size_t k = 1; k < kept_; ++k) std::swap(noted_[k], noted_[2 * k]);
  stride_ *= 2;
}

std::function<formations::PlanObserver&(std::size_t)> ProblemRecorder::of_trial() {
  return [this](std::size_t) -> formations::PlanObserver& { return vehicles_.emplace_back(most_); };
}

Corpus ProblemRecorder::corpus(const scenarios::Scenario& scenario, const std::string& name,
                               const formations::Plan& plan) const {
  Corpus corpus;
  corpus.experiments.push_back(
      {name, scenario.behaviour.setting().write(Registry<formations::Behaviour>::instance()), plan,
       scenario.obstacles,
       scenario.waypoint ? std::optional(scenario.waypoint->place()) : std::nullopt});
  for (const OfVehicle& vehicle : vehicles_) {
    const auto kept = vehicle.kept();
    corpus.situations.insert(corpus.situations.end(), kept.begin(), kept.end());
  }
  return corpus;
}

std::size_t ProblemRecorder::situations() const {
  std::size_t sum = 0;
  for (const OfVehicle& vehicle : vehicles_) sum += vehicle.situations();
  return sum;
}

}  // namespace shoal::analysis
