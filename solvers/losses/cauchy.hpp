#pragma once

#include <cmath>

#include "shoal/solvers/loss.hpp"

namespace shoal::solvers {

/// k^2 log(1 + (r / k)^2): the negative log-likelihood of a Cauchy distribution of scale k.
struct Cauchy final : Loss {
  double scale_m;

  explicit Cauchy(double scale = 30.0) : scale_m(scale) {}

  LossValue at(double squared) const override {
    const double k2 = scale_m * scale_m;
    const double slope = k2 / (k2 + squared);
    return {k2 * std::log1p(squared / k2), slope, -slope * slope / k2};
  }

  static void declare(Options<Cauchy>& o) {
    o.number("scale_m", &Cauchy::scale_m, "m", above(0),
             "residual at which the pull of an outlier begins to fade");
  }
};

}  // namespace shoal::solvers
