#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "shoal/scenarios/currents/netcdf_layout.hpp"

namespace shoal::scenarios {

/// Where in the file the mission has its origin.
struct MissionOrigin {
  std::optional<Eigen::Vector2d> longitude_latitude;  ///< degrees
  Eigen::Vector2d x_y = Eigen::Vector2d::Zero();      ///< metres of a projected grid

  bool operator==(const MissionOrigin&) const = default;
};

/// How the mission's frame (metres from its origin) and a file's grid lie to each other.
///
/// On longitude/latitude axes it is an equirectangular projection with WGS84's radii of curvature
/// at the origin. Its error grows as tan(latitude) d^2 / R with the distance d: 8 m at 10 km from
/// an origin at 27 degrees, 27 m at 60 degrees.
///
/// On a projected grid the frame is the grid's own, moved to the origin; or, with an origin in
/// longitude and latitude, it is turned so that x is east, and scaled to true metres, by the
/// grid's direction and scale at the origin. These are constant over the frame, so that the error
/// grows in the same way with the distance.
struct MissionFrame {
  std::vector<double> x_m, y_m;  ///< nodes, ascending, along the grid's axes from the origin
  std::vector<std::size_t> x_order, y_order;  ///< index in the file of each of them
  Eigen::Matrix2d grid_from_mission = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d mission_from_components = Eigen::Matrix2d::Identity();  ///< of velocities

  struct Degrees {
    Eigen::Vector2d origin, per_metre;  ///< longitude, latitude
  };
  std::optional<Degrees> degrees;  ///< of a frame whose x is east

  /// `x = 10 m, y = -20 m (35.45 E, 27.38 N)`.
  std::string position_text(double x_m, double y_m) const;
  /// `x from -4500 to 4000 m and y from ... (35.40 to 35.49 E, ...)`.
  std::string extent_text() const;
};

/// Throws InputError if the file needs an origin and has none, or has one that it cannot place.
MissionFrame mission_frame(const NetcdfFile& file, const CurrentLayout& layout,
                           const MissionOrigin& origin);

/// Metres along a degree of longitude and of latitude on WGS84 at this latitude.
Eigen::Vector2d metres_per_degree(double latitude_deg);

}  // namespace shoal::scenarios
