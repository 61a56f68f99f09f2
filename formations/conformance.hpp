#pragma once

#include <string>
#include <vector>

#include "shoal/formations/behaviour.hpp"

namespace shoal::formations {

/// How closely a behaviour is held to the symmetries of its problem.
struct Conformance {
  /// Turns of the frame and of the plan are multiples of it. A behaviour that searches rotations
  /// by steps has a symmetry for each of them only.
  double turn_step_deg = 1.0;
  /// Between targets that should be the same; forces are compared to a millionth of their size.
  double tolerance_m = 0.02;
};

/// What holds for every behaviour, tried on swarms that are drawn, always the same: a sentence for
/// each that this one violates. For tests of behaviours of one's own.
///
/// Targets are finite also among degenerate neighbours, and the same when asked again or for
/// several vehicles together. Vehicles that hear no other hold, and so do, if and only if ids are
/// needed, those among strangers. The frame's orientation and origin, that of the plan, the numbers
/// of its slots and the order of the neighbours mean nothing.
std::vector<std::string> violations(const Behaviour& behaviour, const Conformance& asked = {});

}  // namespace shoal::formations
