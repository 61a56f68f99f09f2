#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

Solution refused(const Problem& problem) {
  Solution solution;
  solution.x =
      Problem::Vector::Constant(problem.start.size(), std::numeric_limits<double>::quiet_NaN());
  solution.backend_says = "the solver does not take this problem; its refuses() says why";
  return solution;
}

}  // namespace shoal::solvers
