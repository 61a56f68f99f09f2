#pragma once

#include "shoal/solvers/loss.hpp"

namespace shoal::solvers {

/// k^2 / 3 (1 - (1 - u)^3) with u = (r / k)^2 up to the scale k, constant beyond: the biweight of
/// Beaton and Tukey 1974, scaled so that it begins as r^2.
struct Tukey final : Loss {
  double scale_m;

  explicit Tukey(double scale = 100.0) : scale_m(scale) {}

  LossValue at(double squared) const override {
    const double k2 = scale_m * scale_m;
    if (squared >= k2) return {k2 / 3.0, 0.0, 0.0};
    const double u = squared / k2, left = 1.0 - u;
    // Multiplied out, since the difference of ones would lose small residuals.
    return {squared * (1.0 - u + u * u / 3.0), left * left, -2.0 * left / k2};
  }

  static void declare(Options<Tukey>& o) {
    o.number("scale_m", &Tukey::scale_m, "m", above(0),
             "residuals beyond this have no influence at all");
  }
};

}  // namespace shoal::solvers
