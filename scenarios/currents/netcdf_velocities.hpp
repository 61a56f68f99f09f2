#pragma once

#include <optional>
#include <string>

#include "shoal/scenarios/currents/netcdf_file.hpp"
#include "shoal/scenarios/currents/netcdf_layout.hpp"

namespace shoal::scenarios {

/// The two velocities of a file, and what they are components along if their names say so.
struct VelocityPair {
  const NetcdfVariable* u = nullptr;
  const NetcdfVariable* v = nullptr;
  std::optional<Components> components;
};

/// By name if names are given, else by standard name, else by a common pair of names. Throws
/// InputError if there is none, or more than one.
VelocityPair find_velocities(const NetcdfFile& file, const std::string& u_name,
                             const std::string& v_name);

/// m/s per unit; refuses units that are none of velocity.
double velocity_unit_m_s(const NetcdfFile& file, const NetcdfVariable& variable);

}  // namespace shoal::scenarios
