#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace shoal::solvers {

/// How often slots (m, about their centroid) look the same in a full turn: the greatest k for which
/// a turn by 1/k of a circle about the origin permutes them, to a nanometre for each kilometre of
/// their extent. 1 for slots without such a symmetry, and for a single one.
int rotational_symmetry(std::span<const Eigen::Vector2d> slots);

/// The infinite lattice that slots are part of: all sums of whole multiples of two vectors (m),
/// from any of the slots.
struct SlotLattice {
  Eigen::Vector2d a, b;  ///< the shortest two vectors between slots that are not parallel
  int symmetry = 2;      ///< 4 for a square lattice, 6 for a hexagonal one: turns that permute it

  /// Nothing for slots that are part of no such lattice.
  static std::optional<SlotLattice> of(std::span<const Eigen::Vector2d> slots);

  /// Of a vector between two places of the lattice.
  Eigen::Vector2i coordinates(const Eigen::Vector2d& v) const;
};

}  // namespace shoal::solvers
