#pragma once

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// Unbounded repulsion, constant attraction: f(r) = s^3 / (2 r^2) + r - 3 s, in metres.
///
/// f'(r) = 1 - (s/r)^3 vanishes at r = s only, where f = -3 s / 2. Rypkema 2015, eq. 3.3.
struct ThesisPotential {
  template <class T>
  T operator()(const T& r, double s) const {
    return s * s * s / (2.0 * r * r) + r - 3.0 * s;
  }

  static void declare(Options<ThesisPotential>&) {}
};

}  // namespace shoal::formations
