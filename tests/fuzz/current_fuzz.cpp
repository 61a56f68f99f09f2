// A netCDF file of currents.

#include "fuzzed.hpp"
#include "shoal/scenarios/currents/netcdf_waters.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto file = tests::fuzzed_file("current.nc", input);
  scenarios::waters_of({.file = file,
                        .origin = {},
                        .depth_m = 10.0,
                        .all_levels = true,
                        .clamp = true,
                        .u_variable = {},
                        .v_variable = {}});
}
