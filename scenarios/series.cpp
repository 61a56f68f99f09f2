#include "shoal/scenarios/series.hpp"

#include "shoal/scenarios/mission_time.hpp"

namespace shoal::scenarios {

void write_series(const std::filesystem::path& path, const std::vector<Series>& series,
                  const std::string& start, const FileAttributes& attributes) {
  NetcdfOutput file(path);
  const NetcdfOutput::Group root = file.root();
  file.text(root, "Conventions", "CF-1.8");
  for (const auto& [name, value] : attributes) file.text(root, name, value);

  struct Written {
    const Series& series;
    NetcdfOutput::Variable axis, values;
  };
  std::vector<Written> written;
  for (const Series& each : series) {
    if (each.time_s.empty()) continue;  // an axis of no length would be one without end
    const std::string axis_name = each.name + "_time";
    const auto dimension = file.dimension(root, axis_name, each.time_s.size());
    const auto axis = mission_time(file, axis_name, dimension, start);
    written.push_back({each, axis,
                       file.variable(root, each.name, NetcdfOutput::Type::double_float, {dimension},
                                     each.unit, each.meaning)});
  }
  for (const auto& [each, axis, values] : written) {
    file.put(axis, each.time_s);
    file.put(values, each.values);
  }
  file.finish();
}

}  // namespace shoal::scenarios
