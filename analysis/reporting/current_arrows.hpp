#pragma once

#include <nlohmann/json_fwd.hpp>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::analysis {

/// The corners of a rectangle in the plane, m.
struct Region {
  double west = 0.0, east = 0.0, south = 0.0, north = 0.0;
};

/// The current on a grid over a region (and a little beyond) at instants of a mission, or null
/// where the water is at rest throughout. Where the current is not known there is none.
nlohmann::ordered_json current_arrows(const scenarios::Current& current, const Region& region,
                                      double duration_s);

}  // namespace shoal::analysis
