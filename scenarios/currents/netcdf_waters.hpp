#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "shoal/scenarios/currents/netcdf_field.hpp"
#include "shoal/scenarios/currents/netcdf_frame.hpp"

namespace shoal::scenarios {

/// The remedies for currents that are asked for at a time, or at a place, outside the data.
inline constexpr const char* or_clamp = "set current.netcdf.outside = \"clamp\"";
inline constexpr const char* or_clamp_place = "set current.netcdf.outside = \"clamp_place\"";

/// What of a file of currents is read, and how it is laid out for a mission.
struct WatersRequest {
  std::filesystem::path file;
  MissionOrigin origin;
  double depth_m = 0.0;
  bool all_levels = false;
  bool clamp = false;  ///< outside the depths of the file, take the nearest
  std::string u_variable, v_variable;

  bool operator==(const WatersRequest&) const = default;
};

/// The currents of a file, read into memory; immutable.
struct Waters {
  std::string name;       ///< of the file, as a message shows it
  std::size_t times = 0;  ///< on its time axis; 0 if it has none
  Calendar calendar = Calendar::standard;
  Instant first_time;
  MissionFrame frame;
  VelocityField field;  ///< at the depth asked for; in the grid's frame, seconds since first_time
  /// Of files with two or more levels, if all were asked for: their depths, ascending, and fields.
  std::vector<double> depths_m;
  std::vector<VelocityField> levels;

  /// Throws InputError that begins with the name of the file.
  [[noreturn]] void refuse(const std::string& why) const;
};

/// Reads a file, or shares what was read from it before, as long as that is held and the
/// file has the same size and time of change. Thread-safe: a request for what another thread is
/// reading waits for it. Throws InputError.
std::shared_ptr<const Waters> waters_of(const WatersRequest& request);

}  // namespace shoal::scenarios
