#pragma once

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Sees what is solved, in order: every answer, and if it wants, the problems, too.
///
/// What it is shown is valid during the call only; a smooth problem may be copied and kept.
class SolveObserver {
 public:
  struct Wants {
    bool problems = true;  ///< solved() is called; closed forms state theirs only then
    bool times = false;    ///< else they are given as zero, and no clock is read

    Wants operator|(const Wants& other) const {
      return {problems || other.problems, times || other.times};
    }
  };

  virtual ~SolveObserver() = default;
  virtual Wants wants() const { return {}; }

  virtual void answered(const Answer& answer, double seconds) {
    (void)answer;
    (void)seconds;
  }
  virtual void solved(const Problem& problem, const Solution& answer) {
    (void)problem;
    (void)answer;
  }
  virtual void solved(const RegistrationProblem& problem, const RegistrationSolution& answer) {
    (void)problem;
    (void)answer;
  }
  virtual void solved(const MatchingProblem& problem, const MatchingSolution& answer) {
    (void)problem;
    (void)answer;
  }
};

}  // namespace shoal::solvers
