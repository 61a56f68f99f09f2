#pragma once

#include <numbers>

#include "shoal/formations/potential.hpp"

namespace shoal::formations {

/// The lattice that a pair potential is to lead to: Spears et al. 2004.
///
/// One law for all pairs leads to triangles. For squares of side s the vehicles are of two kinds:
/// like ones belong on the diagonals, so that their distance is taken as r / sqrt(2), and the law
/// keeps them sqrt(2) s apart. Kinds go by the parity of slots, as in W. Spears' own program
/// (formation_newton.nlogo, 2011), which lets unlike vehicles feel one another within 1.7 s and
/// like ones within 1.3 sqrt(2) s: any range between sqrt(2) s and 2 s tells the same neighbours
/// apart.
enum class Lattice { triangles, squares };

inline bool alike(int slot, int other) {
  return (slot - other) % 2 == 0;
}

/// The potential of two vehicles of one kind: its slope at r is that of the law at r / sqrt(2).
inline double value_of_like(const Potential& law, double r, double s) {
  return std::numbers::sqrt2 * law.value(r / std::numbers::sqrt2, s);
}
inline RadialValue derivatives_of_like(const Potential& law, double r, double s) {
  const RadialValue f = law.derivatives(r / std::numbers::sqrt2, s);
  return {std::numbers::sqrt2 * f.value, f.slope, f.curvature / std::numbers::sqrt2};
}

}  // namespace shoal::formations
