#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "shoal/core/registry.hpp"
#include "shoal/solvers/answer.hpp"
#include "shoal/solvers/problem.hpp"

namespace shoal::solvers {

struct Solution : Answer {
  Problem::Vector x;  ///< NaN until set
  int backend_code = 0;
  const char* backend_says = "";  ///< the backend's own sentence
  double violation = 0.0;         ///< of bounds and constraints, recomputed by us
  int distinct_minima = 0;        ///< that a search from many starts came across; 0: did not look
  double seconds = 0.0;
};

/// Minimises a smooth problem from its start.
///
/// Stateless: one solver may serve many threads. Never throws for numerical trouble (that is a
/// status); throws what the objective throws. The same problem gives the same bits, also from
/// methods that draw random numbers: their seed is an option.
class Solver {
 public:
  static constexpr const char* family = "solver";
  static constexpr const char* family_meaning = "minimises smooth problems";

  virtual ~Solver() = default;
  virtual Solution solve(const Problem& problem) const = 0;

  /// Why this solver cannot take the problem ("needs bounds"), or nothing if it can. A problem
  /// that is refused is answered with `bad_input`.
  virtual std::optional<std::string> refuses(const Problem& problem) const = 0;

  /// Why threads that use this solver wait for one another, or nothing if they do not.
  virtual std::optional<std::string> one_at_a_time() const { return std::nullopt; }
};

/// The answer of a solver that refuses the problem.
Solution refused(const Problem& problem);

/// Keeps Ceres from writing warnings to stderr, by way of glog and for the whole process: for
/// programs that own theirs. What it warns of is in the status of the solution.
void silence_backends();

}  // namespace shoal::solvers
