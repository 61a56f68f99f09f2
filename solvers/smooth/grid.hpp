#pragma once

#include <cstdint>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Tries every point of a grid over the whole box, then of finer ones about the best, until the
/// mesh is as fine as the tolerance: slow, and hard to mislead. An oracle for tests.
struct Grid {
  std::int64_t max_evaluations = 1'000'000;
  double x_tolerance_m = 1e-4;
  std::int64_t points_per_axis = 41;

  static void declare(Options<Grid>& o);
};

}  // namespace shoal::solvers
