#pragma once

#include "shoal/formations/behaviour.hpp"
#include "shoal/solvers/matching/matching.hpp"

namespace shoal::formations {

/// Finds out which slots the vehicle and its neighbours take, moves the plan onto them, and goes to
/// the slot found for the vehicle: Rypkema 2015, sec. 3.7, Alg. 8. Needs no ids. Remembers what its
/// matching does.
struct AssignmentRegistration {
  double contact_rangeout_m = 650.0;
  double ownship_weight = 0.1;
  Choice<solvers::Matcher> matching{"sampled"};

  static void declare(Options<AssignmentRegistration>& o);
};

}  // namespace shoal::formations
