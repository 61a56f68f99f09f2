#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace shoal::solvers {

/// How a solve of any family ended, decided by our own check of the answer and not by the backend's
/// word. In this order: those to stalled_at_roundoff are usable, those after it are not.
enum class Status : std::uint8_t {
  converged,  ///< a minimum: of a smooth problem a local one, of a matching the least of all tried
  target_reached,
  undetermined,         ///< a minimum, but the problem leaves part of the answer open
  budget,               ///< the evaluations ran out
  stalled_at_roundoff,  ///< the backend finds nothing lower, but the check finds no minimum
  infeasible,           ///< no point was found that keeps to the constraints
  diverged,             ///< no finite cost, or stopped by one that is not finite
  bad_input,            ///< the problem cannot be posed like this (NaN start, crossed bounds)
  callback_failed,      ///< the objective threw; the exception is rethrown
};
inline constexpr int status_count = 9;
std::string_view name_of(Status status);

/// What the answers of all families of solvers have in common.
struct Answer {
  double cost = std::numeric_limits<double>::quiet_NaN();  ///< in the problem's own unit
  Status status = Status::bad_input;
  int evaluations = 0;  ///< of the cost; 0 for closed forms and enumerations

  /// True if it may be acted upon: finite, feasible, and not worse than the start.
  bool usable() const { return status <= Status::stalled_at_roundoff; }
};

}  // namespace shoal::solvers
