#pragma once

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/lattice.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// Moves as a particle under the forces of its neighbours, with friction:
/// a = -strength sum grad f - friction v.
///
/// The dynamics of the sources whose laws are registered as potentials: F = m a with friction
/// (Spears et al. 2004; 1 - FR per time step there), springs with damping of the own velocity
/// (Shucker and Bennett 2007), Lennard-Jones with a damping term (Pinciroli et al. 2008).
/// attraction_repulsion goes to the minimum instead, where no velocity is left to damp. The own
/// velocity is the one that the vehicle knows of, through the water for a drifter. How large a
/// force may be is the matter of the guidance's envelope.
struct PairForces {
  double contact_rangeout_m = 450.0;
  double separation_m = 300.0;
  Lattice lattice = Lattice::triangles;
  double strength_m_s2 = 0.01;
  double friction_per_s = 0.05;
  Choice<Selection> selection{"in_range"};
  Choice<Potential> potential{"physicomimetics"};

  static void declare(Options<PairForces>& o);
};

}  // namespace shoal::formations
