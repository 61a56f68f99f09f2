#pragma once

#include <memory>
#include <span>
#include <vector>

#include "shoal/core/registry.hpp"
#include "shoal/formations/neighbourhood.hpp"

namespace shoal::formations {

/// Chooses the neighbours that a vehicle goes by, out of those in range.
///
/// The choice depends on the positions only: not on ids or ages, nor (ties aside) on the order of
/// the neighbours, a rotation or a mirror. Out of some neighbours at least one is chosen, none
/// twice. Stateless and thread-safe.
class Selection {
 public:
  static constexpr const char* family = "selection";
  static constexpr const char* family_meaning =
      "which of the neighbours in range a vehicle goes by";

  virtual ~Selection() = default;

  /// `in_range`: positions in metres, own frame (the own position is zero). `chosen` receives
  /// indices into it, in place of what was there; its memory is used again, so that in the steady
  /// state nothing is allocated (delaunay.cpp excepted: CGAL allocates).
  virtual void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const = 0;
};

}  // namespace shoal::formations
