#include "shoal/scenarios/mission_time.hpp"

#include "shoal/core/calendar.hpp"

namespace shoal::scenarios {

NetcdfOutput::Variable mission_time(NetcdfOutput& file, const std::string& name,
                                    NetcdfOutput::Dimension dimension, const std::string& start) {
  const std::string since = iso_text(parse_instant(start, Calendar::standard), Calendar::standard);
  const auto axis = file.variable(file.root(), name, NetcdfOutput::Type::double_float, {dimension},
                                  "seconds since " + since, "time since mission start");
  file.text(axis, "standard_name", "time");
  file.text(axis, "axis", "T");
  file.text(axis, "calendar", "standard");
  return axis;
}

}  // namespace shoal::scenarios
