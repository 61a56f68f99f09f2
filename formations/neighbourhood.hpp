#pragma once

#include <Eigen/Core>
#include <span>

namespace shoal::formations {

/// The slot of a vehicle whose pings carry no id.
inline constexpr int anonymous = -1;

/// What is known of one vehicle nearby.
struct Neighbour {
  Eigen::Vector2d position;  ///< metres, own frame (axes parallel to the world's)
  double age_s = 0.0;        ///< since it was last heard
  int slot = anonymous;      ///< its slot of the plan, if its pings carry an id
};

/// All that a behaviour is told: who is around, which slot is the own one, and where the vehicle
/// is.
struct Neighbourhood {
  std::span<const Neighbour> neighbours;
  int own_slot = 0;
  /// Metres east and north in the fixed frame of the own positions; for way-points only.
  Eigen::Vector2d own_position = Eigen::Vector2d::Zero();
};

}  // namespace shoal::formations
