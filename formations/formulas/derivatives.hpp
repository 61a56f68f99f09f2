#pragma once

#include "shoal/formations/formulas/program.hpp"
#include "shoal/formations/formulas/tree.hpp"

namespace shoal::formations::formulas {

/// Appends a formula and its first two derivatives with respect to r. The value is computed in the
/// order in which it was written, the derivatives as GiNaC simplifies them; kinks (abs, min, max)
/// are differentiated on their sides. Throws InputError if there is no derivative, or if it is out
/// of proportion. Thread-safe. The same formula gives the same steps in every run.
Program differentiated(const Tree& tree);

}  // namespace shoal::formations::formulas
