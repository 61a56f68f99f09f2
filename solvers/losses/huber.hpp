#pragma once

#include <cmath>

#include "shoal/solvers/loss.hpp"

namespace shoal::solvers {

/// r^2 up to the scale k, 2 k |r| - k^2 beyond: Huber 1964, Robust estimation of a location
/// parameter (twice his rho).
struct Huber final : Loss {
  double scale_m;

  explicit Huber(double scale = 30.0) : scale_m(scale) {}

  LossValue at(double squared) const override {
    if (squared <= scale_m * scale_m) return {squared, 1.0, 0.0};
    const double residual = std::sqrt(squared);
    const double slope = scale_m / residual;
    return {2.0 * scale_m * residual - scale_m * scale_m, slope, -0.5 * slope / squared};
  }

  static void declare(Options<Huber>& o) {
    o.number("scale_m", &Huber::scale_m, "m", above(0),
             "residuals beyond this count by their length only");
  }
};

}  // namespace shoal::solvers
