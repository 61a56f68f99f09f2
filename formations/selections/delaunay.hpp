#pragma once

#include <span>
#include <vector>

#include "shoal/formations/selection.hpp"

namespace shoal::formations {

/// The neighbours of the vehicle in the Delaunay triangulation of all positions.
///
/// Of points on one line these are the next on either side. Neighbours on top of one another, or of
/// the vehicle, share a vertex and are chosen together. Predicates are exact: no position is too
/// flat or too close.
struct Delaunay final : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override;

  static void declare(Options<Delaunay>&) {}
};

}  // namespace shoal::formations
