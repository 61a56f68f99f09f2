#pragma once

#include <cmath>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// Lennard-Jones: f(r) = depth ((s/r)^12 - 2 (s/r)^6), in metres; lowest, -depth, at r = s.
///
/// Pinciroli et al. 2008 write 4 depth ((sigma/r)^12 - (sigma/r)^6), lowest at r = 2^(1/6) sigma:
/// the same. Its attraction fades as r^-7, so that distant vehicles are hardly drawn in, which is
/// why the thesis replaced it (Rypkema 2015, sec. 3.4).
struct LennardJones {
  double depth_m = 12.5;  // at s = 300 m as stiff at the separation as the thesis' potential

  template <class T>
  T operator()(const T& r, double s) const {
    using std::pow;
    const T q6 = pow(s / r, 6.0);
    return depth_m * (q6 * (q6 - 2.0));
  }

  static void declare(Options<LennardJones>& o) {
    o.number("depth_m", &LennardJones::depth_m, "m", above(0),
             "of the well; the stiffness at the separation is 72 depth / s^2");
  }
};

}  // namespace shoal::formations
