#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "shoal/solvers/answer.hpp"
#include "shoal/solvers/trace.hpp"

namespace shoal::analysis {

/// A solver's answer to a problem of its family, and where it puts things.
struct SolverAnswer : solvers::Answer {
  std::string refusal;    ///< why the solver does not take the problem, if it does not
  Eigen::VectorXd place;  ///< m: answers are as far apart as these
  double seconds = 0.0;
  std::vector<solvers::Trace::Point> progress;  ///< if wanted, and if the solver descends

  bool solved() const { return status == solvers::Status::converged; }
};

/// Points one below the other, as SolverAnswer::place wants them.
Eigen::VectorXd stacked(std::size_t count, auto point) {
  Eigen::VectorXd all(2 * static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    all.segment<2>(2 * static_cast<Eigen::Index>(i)) = point(i);
  }
  return all;
}

}  // namespace shoal::analysis
