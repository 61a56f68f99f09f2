#include "shoal/analysis/problem_recorder.hpp"

#include "shoal/formations/posed_problems.hpp"

namespace shoal::analysis {
namespace {

struct Counter final : formations::ProblemViewer {
  int count = 0;
  void see(const solvers::Problem&) override { ++count; }
  void see(const solvers::RegistrationProblem&) override { ++count; }
  void see(const solvers::MatchingProblem&) override { ++count; }
};

class Recording final : public formations::Behaviour {
 public:
  Recording(std::shared_ptr<const Behaviour> behaviour,
            std::shared_ptr<ProblemRecorder::BySlot> noted)
      : behaviour_(std::move(behaviour)), noted_(std::move(noted)) {}

  formations::Target step(const formations::Neighbourhood& seen,
                          const formations::Plan& plan) const override {
    Counter posed;
    behaviour_->pose(seen, plan, posed);
    if (posed.count > 0) {
      (*noted_)[static_cast<std::size_t>(seen.own_slot)].push_back(
          {0, seen.own_slot, seen.own, {seen.neighbours.begin(), seen.neighbours.end()}});
    }
    return behaviour_->step(seen, plan);
  }

  void pose(const formations::Neighbourhood& seen, const formations::Plan& plan,
            formations::ProblemViewer& viewer) const override {
    behaviour_->pose(seen, plan, viewer);
  }

  bool needs_ids() const override { return behaviour_->needs_ids(); }
  std::optional<Eigen::Vector2d> waypoint() const override { return behaviour_->waypoint(); }
  bool needs_clock() const override { return behaviour_->needs_clock(); }

 private:
  std::shared_ptr<const Behaviour> behaviour_;
  std::shared_ptr<ProblemRecorder::BySlot> noted_;
};

}  // namespace

ProblemRecorder::ProblemRecorder() : noted_(std::make_shared<BySlot>()) {}

scenarios::BehaviourHook ProblemRecorder::hook() {
  return [noted = noted_](std::shared_ptr<const formations::Behaviour> behaviour,
                          const formations::Plan& plan) {
    noted->assign(static_cast<std::size_t>(plan.size()), {});
    return std::make_shared<const Recording>(std::move(behaviour), noted);
  };
}

Corpus ProblemRecorder::corpus(const scenarios::Scenario& scenario, const std::string& name,
                               const formations::Plan& plan) const {
  Corpus corpus;
  corpus.experiments.push_back(
      {name, scenario.behaviour.setting().write(Registry<formations::Behaviour>::instance()), plan,
       scenario.obstacles});
  for (const std::vector<Situation>& of_vehicle : *noted_) {
    corpus.situations.insert(corpus.situations.end(), of_vehicle.begin(), of_vehicle.end());
  }
  return corpus;
}

}  // namespace shoal::analysis
