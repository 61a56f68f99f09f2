#pragma once

#include "shoal/scenarios/netcdf_output.hpp"

namespace shoal::scenarios {

/// A CF time axis in seconds since the UTC of mission start.
NetcdfOutput::Variable mission_time(NetcdfOutput& file, const std::string& name,
                                    NetcdfOutput::Dimension dimension, const std::string& start);

}  // namespace shoal::scenarios
