#pragma once

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/weighting.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {

/// Moves the plan rigidly onto what was heard and goes to the own slot: Rypkema 2015, sec. 3.6,
/// eq. 3.8, Alg. 7, Table 3.6. Needs ids.
struct RigidRegistration {
  double contact_rangeout_m = 650.0;
  double ownship_weight = 1.0;
  Weighting weighting = Weighting::none;
  double age_scale_s = 120.0;
  Choice<solvers::Loss> loss{"least_squares"};
  Choice<solvers::RegistrationSolver> registration{"procrustes"};

  static void declare(Options<RigidRegistration>& o);
};

}  // namespace shoal::formations
