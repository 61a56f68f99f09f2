#pragma once

#include <Eigen/Core>
#include <span>

#include "shoal/formations/obstacle.hpp"

namespace shoal::formations {

/// The slot of a vehicle whose pings carry no id.
inline constexpr int anonymous = -1;

/// What a vehicle knows of its own motion in the plane. Places are metres east and north in any
/// fixed frame (dead reckoning will do); angles are counter-clockwise from east.
struct OwnState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double heading_rad = 0.0;
  double speed_m_s = 0.0;  ///< forward, through water
  double turn_rate_rad_s = 0.0;
};

/// What is known of one vehicle nearby.
struct Neighbour {
  Eigen::Vector2d position;  ///< metres, own frame (axes parallel to the world's)
  double age_s = 0.0;        ///< since it was last heard
  int slot = anonymous;      ///< its slot of the plan, if its pings carry an id
  // If its pings carry its state; else zero:
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double heading_rad = 0.0;
};

/// All that a behaviour knows: which vehicles are around, which slot is the own one, where the
/// vehicle is and how it moves, and what it is to keep clear of.
struct Neighbourhood {
  std::span<const Neighbour> neighbours;
  int own_slot = 0;
  /// For waypoints, obstacles and velocities only: formations do not depend on where they are.
  OwnState own = {};
  Obstacles obstacles = {};  ///< in the frame of the own positions
  /// Where all vehicles are led to, in that frame; zero if there is no such place.
  Eigen::Vector2d waypoint = Eigen::Vector2d::Zero();
};

}  // namespace shoal::formations
