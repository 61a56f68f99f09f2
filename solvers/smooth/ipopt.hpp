#pragma once

#include <cstdint>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Ipopt: an interior point with the exact Hessian. One solve at a time in a process.
struct InteriorPoint {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  static void declare(Options<InteriorPoint>& o);
};

}  // namespace shoal::solvers
