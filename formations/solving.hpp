#pragma once

#include <chrono>
#include <span>
#include <utility>

#include "shoal/core/memory.hpp"
#include "shoal/solvers/solve_observer.hpp"

namespace shoal::formations {

/// Through which a behaviour solves its problems, so that observers see exactly the problems that
/// were solved and their answers; and what the behaviour remembers of the vehicle.
class Solving {
 public:
  using Observers = std::span<solvers::SolveObserver* const>;
  using Wants = solvers::SolveObserver::Wants;

  Solving() = default;
  /// `memory`: what Behaviour::new_memory() made for the vehicle, or nullptr for the first time.
  explicit Solving(Memory* memory, Observers observers = {})
      : Solving(memory, observers, wants_of(observers)) {}
  /// `wants`: those of all observers.
  Solving(Memory* memory, Observers observers, Wants wants)
      : memory_(memory), observers_(observers), wants_(wants) {}

  Memory* memory() const { return memory_; }

  /// The solver's answer. `more`: what its solve() takes besides the problem.
  template <class Solver, class Problem, class... More>
  auto solve(const Solver& solver, const Problem& problem, More&&... more) const {
    if (observers_.empty()) return solver.solve(problem, std::forward<More>(more)...);
    const double begin = now_s();
    const auto answer = solver.solve(problem, std::forward<More>(more)...);
    const double seconds = now_s() - begin;
    for (solvers::SolveObserver* each : observers_) each->answered(answer, seconds);
    if (wants_.problems) {
      for (solvers::SolveObserver* each : observers_) each->solved({problem, answer});
    }
    return answer;
  }

  /// What has an answer in closed form that no solver gives; `state` returns the problem and its
  /// answer, and is called if an observer wants to see them.
  template <class State>
  void closed_form(State state) const {
    if (observers_.empty()) return;
    solvers::Answer converged;
    converged.status = solvers::Status::converged;
    for (solvers::SolveObserver* each : observers_) each->answered(converged, 0.0);
    if (!wants_.problems) return;
    const auto [problem, answer] = state();
    for (solvers::SolveObserver* each : observers_) each->solved({problem, answer});
  }

  static Wants wants_of(Observers observers) {
    Wants all{.problems = false, .times = false};
    for (const solvers::SolveObserver* each : observers) all = all | each->wants();
    return all;
  }

 private:
  double now_s() const {
    using Clock = std::chrono::steady_clock;
    if (!wants_.times) return 0.0;
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  }

  Memory* memory_ = nullptr;
  Observers observers_;
  Wants wants_{.problems = false, .times = false};
};

}  // namespace shoal::formations
