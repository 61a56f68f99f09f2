#pragma once

#include <cstdint>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/weighting.hpp"
#include "shoal/solvers/loss.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {

enum class Normalisation : std::uint8_t { weights, count };

/// Places the vehicle with respect to every pair of neighbours as planned, and goes to the mean of
/// these places: Rypkema 2015, sec. 3.5, Alg. 6, Table 3.5. Needs ids. With another loss than the
/// square it goes where the weighted sum of losses is least.
///
/// Algorithm 6 projects from the actual midpoint by the planned angle alone; without the actual
/// bearing of the pair the target would not turn with the formation (and its sine and cosine are
/// exchanged for mathematical angles). The invariant that fixes both: with the neighbours placed as
/// planned, up to any rotation and translation, the target is exactly the own slot.
struct PairwiseReferencing {
  double contact_rangeout_m = 650.0;
  Weighting weighting = Weighting::distance;
  double age_scale_s = 120.0;
  Normalisation normalisation = Normalisation::weights;
  Choice<solvers::Loss> loss{"least_squares"};
  Choice<solvers::Solver> solver{"newton"};

  static void declare(Options<PairwiseReferencing>& o);
};

}  // namespace shoal::formations
