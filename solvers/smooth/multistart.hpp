#pragma once

#include <cstdint>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// The best answer of one solver from many starts: a Sobol sequence (low discrepancy), moved by a
/// random shift modulo one, which keeps its evenness (Cranley and Patterson 1976).
struct Multistart {
  std::int64_t starts = 32;
  double radius_m = 500.0;
  double same_minimum_m = 0.1;
  std::int64_t seed = 1;
  Choice<Solver> solver{"newton"};

  static void declare(Options<Multistart>& o);
};

}  // namespace shoal::solvers
