#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/core/calendar.hpp"
#include "shoal/scenarios/currents/netcdf_file.hpp"

namespace shoal::scenarios {

enum class AxisKind { longitude_latitude, projected };

/// What the two velocities are components along.
enum class Components { east_north, grid_axes };

/// A coordinate along one dimension, in the order of the file.
struct CoordinateAxis {
  std::string name;
  std::size_t position = 0;    ///< of its dimension among those of the velocities
  bool is_dimension = false;   ///< false for a scalar coordinate
  std::vector<double> values;  ///< degrees, metres, metres below the surface, or seconds
};

/// Longitude and latitude of every node (degrees), row by row in the order of the file.
struct NodePositions {
  std::vector<double> longitude, latitude;
};

/// What was understood of a file of currents: which variables, on which axes, in which units.
struct CurrentLayout {
  NetcdfVariable u, v;
  double u_unit_m_s = 1.0, v_unit_m_s = 1.0;  ///< m/s per unit of the file
  std::string u_units, v_units;               ///< as the file spells them
  Components components = Components::east_north;

  AxisKind kind = AxisKind::longitude_latitude;
  CoordinateAxis x, y;                     ///< degrees, or metres of the projection
  std::optional<NodePositions> positions;  ///< of a projected grid, where the file has them

  std::optional<CoordinateAxis> depth;  ///< positive down
  std::optional<CoordinateAxis> time;   ///< seconds since `first_time`
  Calendar calendar = Calendar::standard;
  Instant first_time;

  /// True where a mask says land, (y, x); empty without a mask.
  std::vector<bool> land;
};

/// Bytes of memory that it takes to read one time and one level at a go.
double bytes_of_a_slab(const NetcdfFile& file, const CurrentLayout& layout);

/// Understands a CF file (CF-1.8) with currents on regular longitude/latitude or projected axes.
///
/// `u_name` and `v_name` choose the variables; both empty means: find them by standard name, else
/// by a common name. Throws InputError with the reason for anything that would need a guess.
CurrentLayout understand(const NetcdfFile& file, const std::string& u_name,
                         const std::string& v_name);

}  // namespace shoal::scenarios
