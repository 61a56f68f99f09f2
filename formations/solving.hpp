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

  Solving() = default;
  /// `memory`: what Behaviour::new_memory() made for the vehicle, or nullptr for the first time.
  explicit Solving(Memory* memory, Observers observers = {})
      : memory_(memory), observers_(observers) {}

  Memory* memory() const { return memory_; }
  bool observed() const { return !observers_.empty(); }

  /// The solver's answer. `more`: what its solve() takes besides the problem.
  template <class Solver, class Problem, class... More>
  auto solve(const Solver& solver, const Problem& problem, More&&... more) const {
    return answer(problem, [&] { return solver.solve(problem, std::forward<More>(more)...); });
  }

  /// The answer that is computed without a solver, as in closed form.
  template <class Problem, class Compute>
  auto answer(const Problem& problem, Compute compute) const {
    if (!observed()) return compute();
    const auto begin = std::chrono::steady_clock::now();
    auto computed = compute();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    for (solvers::SolveObserver* each : observers_) each->solved(problem, computed, taken.count());
    return computed;
  }

 private:
  Memory* memory_ = nullptr;
  Observers observers_;
};

}  // namespace shoal::formations
