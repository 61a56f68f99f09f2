#pragma once

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Sees each problem that is solved, with its answer and the time that took, in order.
///
/// What it is shown is valid during the call only; a smooth problem may be copied and kept.
class SolveObserver {
 public:
  virtual ~SolveObserver() = default;
  virtual void solved(const Problem& problem, const Solution& answer, double seconds) = 0;
  virtual void solved(const RegistrationProblem& problem, const RegistrationSolution& answer,
                      double seconds) = 0;
  virtual void solved(const MatchingProblem& problem, const MatchingSolution& answer,
                      double seconds) = 0;
};

}  // namespace shoal::solvers
