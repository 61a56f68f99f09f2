#include "shoal/analysis/experiments/measures/held_slots.hpp"

#include "shoal/analysis/experiments/measures/formation_quality.hpp"

namespace shoal::analysis {

std::vector<Eigen::Vector2d> HeldSlots::positions() const {
  std::vector<Eigen::Vector2d> positions;
  for (const int index : slot) positions.push_back(padded.slot(index));
  return positions;
}

HeldSlots held_slots(const scenarios::World& world, std::span<const Eigen::Vector2d> places) {
  const scenarios::QualityOptions& quality = world.scenario().quality;
  HeldSlots held{world.scenario().plan.make()->padded(static_cast<int>(quality.layers)), {}};
  FormationQuality measure(held.padded, quality);
  measure.of(places);
  held.slot.assign(measure.slot_of_position().begin(), measure.slot_of_position().end());
  return held;
}

}  // namespace shoal::analysis
