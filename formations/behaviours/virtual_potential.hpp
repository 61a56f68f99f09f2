#pragma once

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/fields/virtual_potential.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {

/// The total control force of a waypoint, obstacles, rotors and formation cells: Barisic et al.
/// 2011, eq. 5, 21, 25. Needs no ids.
struct VirtualPotentialForce {
  double contact_rangeout_m = 200.0;
  double lead_s = 0.0;
  VirtualPotentialGains gains;

  static void declare(Options<VirtualPotentialForce>& o);
};

/// The same potential as a local optimisation problem: the minimum within reach is the target, and
/// the vehicle's guidance steers there. Rotors, which have no potential, and damping, which
/// guidance does not need, are left out.
struct VirtualPotentialStep {
  double contact_rangeout_m = 200.0;
  double lead_s = 0.0;
  VirtualPotentialGains gains;
  double reach_m = 30.0;
  Choice<solvers::Solver> solver{"newton"};

  static void declare(Options<VirtualPotentialStep>& o);
};

}  // namespace shoal::formations
