#pragma once

#include <cstdint>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Ceres: limited-memory BFGS.
struct CeresLbfgs {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  static void declare(Options<CeresLbfgs>& o);
};

/// Ceres: BFGS.
struct CeresBfgs {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  static void declare(Options<CeresBfgs>& o);
};

/// Ceres: Levenberg-Marquardt on residuals, with robust losses.
struct CeresLeastSquares {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  static void declare(Options<CeresLeastSquares>& o);
};

}  // namespace shoal::solvers
