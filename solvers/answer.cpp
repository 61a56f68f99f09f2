#include "shoal/solvers/answer.hpp"

namespace shoal::solvers {

std::string_view name_of(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::target_reached:
      return "target_reached";
    case Status::undetermined:
      return "undetermined";
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

}  // namespace shoal::solvers
