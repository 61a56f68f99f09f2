#pragma once

#include <cstdint>

#include "shoal/core/options.hpp"

namespace shoal::solvers {

/// When a solver has to stop. Every solver of smooth problems has these options, and every one is
/// held to them by Attempt, whatever its backend makes of them.
struct Limits {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  /// Of a solver with options of these names.
  template <class Solver>
  static Limits of(const Solver& options) {
    return {options.max_evaluations, options.x_tolerance_m};
  }
};

/// Declares them among the options of a solver.
template <class Solver>
void declare_limits(Options<Solver>& o) {
  o.integer("max_evaluations", &Solver::max_evaluations, "", in(1, 1e9),
            "evaluations of the cost after which the solver stops");
  // The optimum lies near the origin of the own frame, where a relative tolerance cannot be met.
  o.number("x_tolerance_m", &Solver::x_tolerance_m, "m", in(1e-9, 1e6),
           "step below which the solver stops, absolute");
}

}  // namespace shoal::solvers
