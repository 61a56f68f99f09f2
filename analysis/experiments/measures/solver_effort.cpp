#include <array>
#include <deque>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

using solvers::Status;

/// The ways in which a solve fails to find the answer, and the trial goes on.
constexpr std::array failures{Status::undetermined, Status::budget,   Status::stalled_at_roundoff,
                              Status::infeasible,   Status::diverged, Status::bad_input};

std::string share_of(Status status) {
  return "solve_" + std::string(name_of(status)) + "_share";
}

/// What the planner of one vehicle had solved.
struct Tally final : formations::PlanObserver {
  bool timed = false;
  double targets = 0.0, solves = 0.0, evaluations = 0.0, seconds = 0.0;
  std::array<double, solvers::status_count> by_status{};

  Wants wants() const override { return {.problems = false, .times = timed}; }
  void answered(const solvers::Answer& answer, double taken_s) override {
    ++solves;
    evaluations += answer.evaluations;
    seconds += taken_s;
    ++by_status[static_cast<std::size_t>(answer.status)];
  }
  void planned(const formations::Neighbourhood&, const formations::Target&) override { ++targets; }
};

/// What the solvers do for a behaviour: how often, at what cost, and how often in vain.
class SolverEffort final : public Measure {
 public:
  static void declare(Options<SolverEffort>&) {}

  std::vector<Quantity> values() const override {
    std::vector<Quantity> all{
        {"solves_per_target", "", "problems solved for a target"},
        {"solve_evaluations", "", "evaluations of the cost for a problem; 0 for closed forms"},
        {"solve_time_s", "s", "time for a problem, if trial.time_solves; it differs between runs"}};
    for (const Status status : failures) {
      all.push_back(
          {share_of(status), "",
           "share of the problems solved with the status " + std::string(name_of(status))});
    }
    return all;
  }

  void begin(const scenarios::World& world) override {
    timed_ = world.scenario().trial.time_solves;
  }

  formations::PlanObserver* plan_observer(std::size_t) override {
    tallies_.emplace_back().timed = timed_;
    return &tallies_.back();
  }

  void finish(const scenarios::World&, Results& results) const override {
    Tally all;
    for (const Tally& each : tallies_) {
      all.targets += each.targets;
      all.solves += each.solves;
      all.evaluations += each.evaluations;
      all.seconds += each.seconds;
      for (std::size_t k = 0; k < all.by_status.size(); ++k) all.by_status[k] += each.by_status[k];
    }
    const auto per = [](double sum, double count) {
      return count > 0.0 ? std::optional(sum / count) : std::nullopt;
    };
    results.add("solves_per_target", per(all.solves, all.targets));
    results.add("solve_evaluations", per(all.evaluations, all.solves));
    results.add("solve_time_s", timed_ ? per(all.seconds, all.solves) : std::nullopt);
    for (const Status status : failures) {
      results.add(share_of(status),
                  per(all.by_status[static_cast<std::size_t>(status)], all.solves));
    }
  }

 private:
  bool timed_ = false;
  std::deque<Tally> tallies_;  // stay where they are
};

const Register<Measure, SolverEffort> registered{
    "solver_effort", "what solvers do for a behaviour, and how often they fail"};

}  // namespace
}  // namespace shoal::analysis
