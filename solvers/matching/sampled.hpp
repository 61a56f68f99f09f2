#pragma once

#include <cstdint>

#include "shoal/solvers/matching/matching.hpp"

namespace shoal::solvers {

enum class Centroids : std::uint8_t { weighted, plain };

/// Tries every slot as seed of the part of the plan that is seen, and every rotation by a multiple
/// of delta theta; the cheapest assignment wins (Rypkema 2015, sec. 3.7, Alg. 8).
struct Sampled {
  double delta_theta_deg = 45.0;
  double tie_m = 0.5;
  Centroids centroids = Centroids::weighted;

  static void declare(Options<Sampled>& o);
};

}  // namespace shoal::solvers
