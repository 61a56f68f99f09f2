#pragma once

#include <string>
#include <vector>

#include "shoal/solvers/problem.hpp"

namespace shoal::solvers::tests {

/// A problem whose answer is known: every solver is asked to find it, or to say why it cannot.
struct KnownProblem {
  std::string name;    ///< like_this
  std::string source;  ///< of the problem, and of the start where that is not the source's own
  Problem problem;     ///< `best_known` is set; bounds are there if the source has them
  /// The lowest points, to at least nine digits, as far as they are single points.
  std::vector<Problem::Vector> minimisers;
  /// There are local minima that are higher. The start is in the basin of a lowest point.
  bool several_minima = false;
  /// There is a curve of lowest points besides: then the cost tells whether it is solved.
  bool curve_of_minimisers = false;
};

/// Fresh ones, at each call in the same order. At most six unknowns each, the first with one.
std::vector<KnownProblem> known_problems();
std::vector<std::string> names_of_known_problems();
KnownProblem known_problem(const std::string& name);

/// The problem in a finite box, for solvers that search one: its own bounds where they are finite,
/// else some way around the start and the minimisers. Nothing in it is lower than `best_known`.
Problem boxed(const KnownProblem& known);

}  // namespace shoal::solvers::tests
