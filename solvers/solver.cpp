#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

std::string_view name_of(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::target_reached:
      return "target_reached";
    case Status::budget:
      return "budget";
    case Status::stalled_at_roundoff:
      return "stalled_at_roundoff";
    case Status::infeasible:
      return "infeasible";
    case Status::diverged:
      return "diverged";
    case Status::bad_input:
      return "bad_input";
    case Status::callback_failed:
      return "callback_failed";
  }
  return "unknown";
}

Solution refused(const Problem& problem) {
  Solution solution;
  solution.x.setConstant(problem.start.size(), std::numeric_limits<double>::quiet_NaN());
  solution.backend_says = "the solver does not take this problem; its refuses() says why";
  return solution;
}

}  // namespace shoal::solvers
