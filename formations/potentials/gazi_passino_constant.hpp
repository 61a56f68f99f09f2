#pragma once

#include <cmath>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// Constant attraction, unbounded repulsion: f'(r) = a - b / r, which vanishes at r = s for
/// b = a s. Gazi and Passino 2002. The integral is f(r) = a (r - s ln(r/s)), in metres.
struct GaziPassinoConstant {
  double attraction = 1.0;

  template <class T>
  T operator()(const T& r, double s) const {
    using std::log;
    return attraction * (r - s * log(r / s));
  }

  static void declare(Options<GaziPassinoConstant>& o) {
    o.number("attraction", &GaziPassinoConstant::attraction, "", above(0),
             "a: pull from far away; the stiffness at the separation is a / s");
  }
};

}  // namespace shoal::formations
