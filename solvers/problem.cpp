#include "shoal/solvers/problem.hpp"

#include <tuple>

namespace shoal::solvers {

Problem::Problem(const Problem& other)
    : start(other.start),
      lower(other.lower),
      upper(other.upper),
      constraints(other.constraints),
      equalities(other.equalities),
      least_squares(other.least_squares),
      best_known(other.best_known),
      trace(other.trace) {
  adopt(*other.objective_);
}

Problem& Problem::operator=(const Problem& other) {
  if (this == &other) return *this;
  release();
  start = other.start;
  lower = other.lower;
  upper = other.upper;
  constraints = other.constraints;
  equalities = other.equalities;
  least_squares = other.least_squares;
  best_known = other.best_known;
  trace = other.trace;
  adopt(*other.objective_);
  return *this;
}

Problem::~Problem() {
  release();
}

void Problem::adopt(const Objective& objective) {
  std::tie(objective_, on_heap_) = objective.copy_into(in_place_, in_place_bytes);
}

void Problem::release() {
  if (on_heap_) {
    delete objective_;
  } else if (objective_) {
    objective_->~Objective();
  }
  objective_ = nullptr;
  on_heap_ = false;
}

}  // namespace shoal::solvers
