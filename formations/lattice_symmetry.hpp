#pragma once

#include "shoal/formations/plan.hpp"

namespace shoal::formations {

/// The greatest n of 6, 4 and 2 for which a turn by 1/n of a circle maps the bonds between nearest
/// slots onto one another: 6 for a hexagonal lattice, 4 for a square one. A plan of one slot has no
/// bonds, and 1.
int lattice_symmetry(const Plan& plan);

}  // namespace shoal::formations
