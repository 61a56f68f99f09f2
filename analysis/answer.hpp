#pragma once

#include <Eigen/Core>
#include <string>

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::analysis {

/// A solver's answer to a problem, in a form that all families share.
struct SolverAnswer {
  bool refused = false;
  bool solved = false;
  std::string status;     ///< of one that was refused, the reason
  Eigen::VectorXd place;  ///< where the answer puts things, m: answers are as far apart as these
  double cost = 0.0;
  int evaluations = 0;  ///< 0 for closed forms and enumerations
  double seconds = 0.0;
};

SolverAnswer answered(const solvers::Solver& solver, const solvers::Problem& problem);
SolverAnswer answered(const solvers::RegistrationSolver& solver,
                      const solvers::RegistrationProblem& problem);
SolverAnswer answered(const solvers::Matcher& solver, const solvers::MatchingProblem& problem);

}  // namespace shoal::analysis
