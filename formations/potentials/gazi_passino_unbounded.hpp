#pragma once

#include <cmath>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// Linear attraction, unbounded repulsion: f'(r) = a r - b / r, which vanishes at r = s for
/// b = a s^2. Gazi and Passino 2002. The integral is f(r) = a (r^2 / 2 - s^2 ln(r/s)), in metres.
struct GaziPassinoUnbounded {
  double attraction_per_m = 0.005;  // the stiffness at the separation is twice this

  template <class T>
  T operator()(const T& r, double s) const {
    using std::log;
    return attraction_per_m * (0.5 * r * r - s * s * log(r / s));
  }

  static void declare(Options<GaziPassinoUnbounded>& o) {
    o.number("attraction_per_m", &GaziPassinoUnbounded::attraction_per_m, "1/m", above(0),
             "a: pull per metre; the stiffness at the separation is 2 a");
  }
};

}  // namespace shoal::formations
