#include "shoal/analysis/report/recorded_run.hpp"

#include <algorithm>

#include "shoal/core/error.hpp"
#include "shoal/scenarios/currents/netcdf_file.hpp"

namespace shoal::analysis {
namespace {

using scenarios::NetcdfFile;
using scenarios::NetcdfVariable;

std::vector<double> all_of(const NetcdfFile& file, const NetcdfVariable& variable) {
  std::vector<std::size_t> start, count;
  for (const scenarios::NetcdfDimension& dimension : variable.dimensions) {
    start.push_back(0);
    count.push_back(dimension.length);
  }
  std::vector<double> values;
  file.read(variable, start, count, values);
  return values;
}

}  // namespace

const std::vector<double>& RecordedRun::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, [](const auto& c) { return c.first; });
  if (found == columns.end()) throw InputError("run.nc has no " + name);
  return found->second;
}

RecordedRun read_recorded_run(const std::filesystem::path& path) {
  const NetcdfFile file(path);
  const NetcdfVariable* time = file.find("time");
  const NetcdfVariable* x = file.find("x");
  if (!time || !x || x->dimensions.size() != 2 || x->dimensions[0].name != "vehicle" ||
      x->dimensions[1].name != "time") {
    file.refuse("is none that shoal run wrote");
  }
  RecordedRun run;
  run.time_s = all_of(file, *time);
  run.vehicles = x->dimensions[0].length;
  for (const NetcdfVariable& variable : file.variables()) {
    if (!variable.is_numeric) continue;
    if (variable.dimensions == x->dimensions) {
      run.columns.emplace_back(variable.name, all_of(file, variable));
    } else if (variable.dimensions.size() == 1) {
      const NetcdfVariable* axis = file.find(variable.dimensions[0].name);
      if (!axis || axis == &variable || axis->name != variable.name + "_time") continue;
      run.series.push_back({variable.name, file.text(variable, "units"),
                            file.text(variable, "long_name"), all_of(file, *axis),
                            all_of(file, variable)});
    }
  }
  return run;
}

}  // namespace shoal::analysis
