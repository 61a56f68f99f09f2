#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"

namespace shoal::analysis {

/// How well vehicles keep a formation: the mean distance (m) between them and the slots of a
/// (padded) plan, assigned and laid onto them as well as a search over rotations finds.
///
/// Rypkema 2015, sec. 4.3, fig. 4.4. Zero for the perfect formation, unbounded above. Reflected
/// formations do not count as the same.
class FormationQuality {
 public:
  /// The plan needs as many slots as there are vehicles, or more.
  FormationQuality(const formations::Plan& plan, scenarios::QualityOptions::Alignment alignment,
                   double delta_theta_deg);

  /// Positions in metres, finite, at least one.
  double of(std::span<const Eigen::Vector2d> positions);

  /// The slot of each position, as the last of() assigned them.
  std::span<const int> slot_of_position() const { return search_.slot_of_point(); }

 private:
  scenarios::QualityOptions::Alignment alignment_;
  solvers::Turns turns_;
  std::vector<Eigen::Vector2d> slots_;  // relative to their centre of rotation
  solvers::AlignedSlots aligned_;
  solvers::RotationSearch search_;
  std::vector<Eigen::Vector2d> centred_;
  int last_turn_ = 0;  // most likely near the next one: it bounds the search
};

}  // namespace shoal::analysis
