#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// A trust region about Newton's method on exact derivatives.
struct Newton {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;
  double first_radius_m = 30.0;
  double largest_radius_m = 100.0;

  std::optional<std::string> complaint() const;
  static void declare(Options<Newton>& o);
};

}  // namespace shoal::solvers
