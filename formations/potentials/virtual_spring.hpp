#pragma once

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// A virtual spring of natural length s: f'(r) = k (r - s), f(r) = k (r - s)^2 / 2, in metres.
///
/// Which springs there are is the matter of the neighbour selection: `acute_angle` creates and cuts
/// them by the rule of Shucker and Bennett 2007, anew at every plan. Their damping is the friction
/// of the behaviour pair_forces. Fujibayashi et al. 2002 make the number, the stiffness and the
/// length of springs depend on how many a vehicle and its neighbour have: a vehicle here does not
/// know that of its neighbours, and springs have no memory, so that they cannot be created below
/// one distance and cut beyond another.
struct VirtualSpring {
  double stiffness_per_m = 0.01;  // at s = 300 m that of the thesis' potential

  template <class T>
  T operator()(const T& r, double s) const {
    const T stretch = r - s;
    return 0.5 * stiffness_per_m * stretch * stretch;
  }

  static void declare(Options<VirtualSpring>& o) {
    o.number("stiffness_per_m", &VirtualSpring::stiffness_per_m, "1/m", above(0),
             "k: force per metre of stretch");
  }
};

}  // namespace shoal::formations
