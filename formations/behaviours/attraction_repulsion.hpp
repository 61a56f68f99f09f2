#pragma once

#include <cstdint>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/cohesion.hpp"
#include "shoal/formations/lattice.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {

enum class Combination { sum, mean };

/// Goes to the nearest minimum of an attraction/repulsion potential of some neighbours: Rypkema
/// 2015, sec. 3.4, Alg. 5. Needs no plan, and ids only to tell the kinds of a lattice of squares.
struct AttractionRepulsion {
  double contact_rangeout_m = 650.0;
  double separation_m = 300.0;
  Lattice lattice = Lattice::triangles;
  Combination combination = Combination::sum;
  double damping_per_m = 0.0;
  Choice<Selection> selection{"two_neighbours"};
  Choice<Cohesion> cohesion{"centroid"};
  Choice<Potential> potential{"thesis"};
  Choice<solvers::Solver> solver{"newton"};

  static void declare(Options<AttractionRepulsion>& o);
};

}  // namespace shoal::formations
