#include "shoal/analysis/reporting/recorded_run.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/behaviour.hpp"
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

/// What a file holds that shoal wrote, and a page can show.
void require_possible(const NetcdfFile& file, const NetcdfVariable& variable,
                      const std::vector<double>& values) {
  constexpr double farthest = 1e12;
  const bool is_reason = variable.name == "target_reason";
  const bool is_flag = variable.name == "thrusting";
  const auto possible = [&](double x) {
    if (std::isnan(x)) return variable.name != "time";
    if (is_reason) return x >= 0.0 && x < formations::reason_count && x == std::floor(x);
    if (is_flag) return x == 0.0 || x == 1.0;
    return std::abs(x) <= farthest;
  };
  const auto wrong = std::ranges::find_if_not(values, possible);
  if (wrong != values.end()) {
    file.refuse(variable.name + " is " + shortest(*wrong) + " somewhere, as in no run of shoal");
  }
}

void require_rising_seconds(const NetcdfFile& file, const NetcdfVariable& time,
                            const std::vector<double>& values) {
  const std::string units = file.text(time, "units");
  if (!units.starts_with("seconds since ")) {
    file.refuse("time is in \"" + units + "\", and not in seconds, as in every run of shoal");
  }
  const auto stuck = std::ranges::adjacent_find(values, std::greater_equal{});
  if (stuck != values.end()) {
    file.refuse("time is " + shortest(stuck[0]) + " and then " + shortest(stuck[1]) +
                ", as in no run of shoal");
  }
}

bool is_along(const NetcdfVariable* variable, std::vector<std::string> dimensions) {
  return variable && variable->is_numeric &&
         std::ranges::equal(variable->dimensions, dimensions, {},
                            &scenarios::NetcdfDimension::name);
}

void read_vehicles(const NetcdfFile& file, RecordedRun& run) {
  const NetcdfVariable* time = file.find("time");
  const NetcdfVariable* x = file.find("x");
  if (!is_along(time, {"time"}) || !is_along(x, {"vehicle", "time"})) {
    file.refuse("is none that shoal run wrote");
  }
  if (x->dimensions[0].length == 0) file.refuse("holds no vehicle");
  run.time_s = all_of(file, *time);
  require_possible(file, *time, run.time_s);
  require_rising_seconds(file, *time, run.time_s);
  run.vehicles = x->dimensions[0].length;
  for (const NetcdfVariable& variable : file.variables()) {
    if (!variable.is_numeric || variable.dimensions != x->dimensions) continue;
    run.columns.emplace_back(variable.name, all_of(file, variable));
    require_possible(file, variable, run.columns.back().second);
  }
}

std::vector<scenarios::Series> series_of(const NetcdfFile& file) {
  std::vector<scenarios::Series> series;
  for (const NetcdfVariable& variable : file.variables()) {
    const std::string axis_name = variable.name + "_time";
    const NetcdfVariable* axis = file.find(axis_name);
    if (!is_along(&variable, {axis_name}) || !is_along(axis, {axis_name})) continue;
    series.push_back({variable.name, file.text(variable, "units"), file.text(variable, "long_name"),
                      all_of(file, *axis), all_of(file, variable)});
  }
  return series;
}

}  // namespace

const std::vector<double>& RecordedRun::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name, [](const auto& c) { return c.first; });
  if (found == columns.end()) throw InputError("run.nc has no " + name);
  return found->second;
}

RecordedRun read_recorded_run(const std::filesystem::path& folder) {
  RecordedRun run;
  scenarios::read_netcdf(folder / "run.nc",
                         [&](const NetcdfFile& file) { read_vehicles(file, run); });
  run.series = scenarios::read_netcdf(folder / "series.nc", series_of);
  return run;
}

}  // namespace shoal::analysis
