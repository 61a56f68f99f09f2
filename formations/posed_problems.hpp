#pragma once

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/problem.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {

/// Somebody who is shown the problems that a behaviour poses, in the order in which it solves them:
/// to compare solvers on them, say. What is shown is valid during the call only; a smooth problem
/// may be copied and kept.
class ProblemViewer {
 public:
  virtual ~ProblemViewer() = default;
  virtual void see(const solvers::Problem& problem) = 0;
  virtual void see(const solvers::RegistrationProblem& problem) = 0;
  virtual void see(const solvers::MatchingProblem& problem) = 0;
};

}  // namespace shoal::formations
