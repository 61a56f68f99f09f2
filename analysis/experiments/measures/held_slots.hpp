#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::analysis {

/// The slots of the padded plan that vehicles hold, as the formation quality assigns them.
struct HeldSlots {
  formations::Plan padded;
  std::vector<int> slot;  ///< of each place

  /// Metres, in the frame of the plan, in the order of the places.
  std::vector<Eigen::Vector2d> positions() const;
};

/// Places in metres, at least one. The trial must be one whose quality is measured.
HeldSlots held_slots(const scenarios::World& world, std::span<const Eigen::Vector2d> places);

}  // namespace shoal::analysis
