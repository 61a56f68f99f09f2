#pragma once

#include <typeinfo>

#include "shoal/solvers/answer.hpp"

namespace shoal::solvers {

/// A problem of any family and its answer, as an observer sees them. Both are borrowed.
class Solved {
 public:
  template <class Problem, class Solution>
  Solved(const Problem& problem, const Solution& answer)
      : problem_type_(typeid(Problem)),
        answer_type_(typeid(Solution)),
        problem_(&problem),
        answer_(&answer) {}

  /// The problem, or nullptr if it is of another type: `problem<MatchingProblem>()`.
  template <class Problem>
  const Problem* problem() const {
    return problem_type_ == typeid(Problem) ? static_cast<const Problem*>(problem_) : nullptr;
  }

  /// The answer, or nullptr if it is of another type: `answer<MatchingSolution>()`.
  template <class Solution>
  const Solution* answer() const {
    return answer_type_ == typeid(Solution) ? static_cast<const Solution*>(answer_) : nullptr;
  }

 private:
  const std::type_info& problem_type_;
  const std::type_info& answer_type_;
  const void* problem_;
  const void* answer_;
};

/// Sees what is solved, in order: every answer, and if it wants, the problems, too.
///
/// What it is shown is valid during the call only; a smooth problem may be copied and kept.
class SolveObserver {
 public:
  struct Wants {
    bool problems = true;  ///< solved() is called; closed forms state theirs only then
    bool times = false;    ///< else they are given as zero, and no clock is read

    Wants operator|(const Wants& other) const {
      return {problems || other.problems, times || other.times};
    }
  };

  virtual ~SolveObserver() = default;
  virtual Wants wants() const { return {}; }

  virtual void answered(const Answer& answer, double seconds) {
    (void)answer;
    (void)seconds;
  }
  virtual void solved(const Solved& what) { (void)what; }
};

}  // namespace shoal::solvers
