#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "shoal/core/registry.hpp"
#include "shoal/solvers/problem.hpp"

namespace shoal::solvers {

/// How a solve ended, decided by our own check of the point and not by the backend's word.
enum class Status : std::uint8_t {
  converged,
  target_reached,
  budget,               ///< the evaluations ran out
  stalled_at_roundoff,  ///< no further progress is possible in floating point
  infeasible,
  diverged,         ///< no finite cost or no finite point
  bad_input,        ///< the problem cannot be posed like this (NaN start, crossed bounds)
  callback_failed,  ///< the objective threw; the exception is rethrown
};
std::string_view name_of(Status status);

struct Solution {
  Problem::Vector x;  ///< NaN until set
  double cost = std::numeric_limits<double>::quiet_NaN();
  Status status = Status::bad_input;
  int backend_code = 0;
  const char* backend_says = "";  ///< the backend's own sentence
  double violation = 0.0;         ///< of bounds, recomputed by us
  int evaluations = 0;
  double seconds = 0.0;

  /// True if x may be acted upon: finite, inside the bounds, and not worse than the start.
  bool usable() const {
    return status == Status::converged || status == Status::target_reached ||
           status == Status::budget || status == Status::stalled_at_roundoff;
  }
};

/// Minimises a smooth problem from its start.
///
/// Stateless: one solver may serve many threads if `thread_safe()`. Never throws for numerical
/// trouble (that is a status); throws what the objective throws.
class Solver {
 public:
  static constexpr const char* family = "solver";
  static constexpr const char* family_meaning = "minimises smooth problems";

  virtual ~Solver() = default;
  virtual Solution solve(const Problem& problem) const = 0;

  /// Why this solver cannot take the problem ("needs bounds"), or nothing if it can.
  virtual std::optional<std::string> refuses(const Problem& problem) const = 0;
  virtual bool thread_safe() const { return true; }
};

}  // namespace shoal::solvers
