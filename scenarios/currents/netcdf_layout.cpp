#include "shoal/scenarios/currents/netcdf_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/netcdf_values.hpp"
#include "shoal/scenarios/currents/netcdf_velocities.hpp"

namespace shoal::scenarios {
namespace {

enum class AxisRole { none, longitude, latitude, x, y, depth, time };

bool is_one_of(const std::string& text, std::initializer_list<const char*> words) {
  return std::ranges::any_of(words, [&](const char* word) { return text == word; });
}

/// Metres per unit, or 0 if it is no length.
double length_unit_m(const std::string& units) {
  if (is_one_of(units, {"m", "meter", "meters", "metre", "metres"})) return 1.0;
  if (is_one_of(units, {"km", "kilometer", "kilometers", "kilometre", "kilometres"})) return 1000.0;
  return 0.0;
}

/// What a coordinate variable measures (CF-1.8, ch. 4): by its units where these are telling, else
/// by standard name, axis and name.
AxisRole role_of(const NetcdfFile& file, const NetcdfVariable& variable) {
  if (!variable.is_numeric) return AxisRole::none;
  const std::string units = file.text(variable, "units");
  const std::string name = file.text(variable, "standard_name");
  const std::string axis = file.text(variable, "axis");
  if (is_one_of(name, {"grid_longitude", "grid_latitude"})) {
    file.refuse("the axes are longitude and latitude about a rotated pole (" + variable.name +
                "), which shoal does not read; regrid the currents to longitude and latitude");
  }
  if (is_one_of(units,
                {"degrees_east", "degree_east", "degree_E", "degrees_E", "degreeE", "degreesE"}) ||
      (name == "longitude" && is_one_of(units, {"degrees", "degree"}))) {
    return AxisRole::longitude;
  }
  if (is_one_of(units, {"degrees_north", "degree_north", "degree_N", "degrees_N", "degreeN",
                        "degreesN"}) ||
      (name == "latitude" && is_one_of(units, {"degrees", "degree"}))) {
    return AxisRole::latitude;
  }
  if (name == "time" || looks_like_time_units(units)) return AxisRole::time;
  const bool vertical = axis == "Z" || !file.text(variable, "positive").empty() ||
                        is_one_of(name, {"depth", "height", "altitude"}) ||
                        is_one_of(variable.name, {"depth", "lev", "z"});
  if (vertical) return AxisRole::depth;
  if (name == "projection_x_coordinate" || axis == "X" || is_one_of(variable.name, {"x", "X"})) {
    return AxisRole::x;
  }
  if (name == "projection_y_coordinate" || axis == "Y" || is_one_of(variable.name, {"y", "Y"})) {
    return AxisRole::y;
  }
  return AxisRole::none;
}

std::string dimensions_text(const NetcdfVariable& variable) {
  std::string text = variable.name + "(";
  for (const NetcdfDimension& dimension : variable.dimensions) {
    text += (text.back() == '(' ? "" : ", ") + dimension.name;
  }
  return text + ")";
}

/// The 1-D variable that gives a dimension its coordinates: the one of the same name, else the
/// only one whose attributes say what it measures. nullptr if there is none.
const NetcdfVariable* coordinate_of(const NetcdfFile& file, const NetcdfDimension& dimension) {
  const auto along_it = [&](const NetcdfVariable& variable) {
    return variable.dimensions.size() == 1 && variable.dimensions[0] == dimension;
  };
  const NetcdfVariable* found = file.find(dimension.name);
  if (found && along_it(*found)) return found;
  found = nullptr;
  for (const NetcdfVariable& variable : file.variables()) {
    if (!along_it(variable) || role_of(file, variable) == AxisRole::none) continue;
    if (found) {
      file.refuse("the dimension " + dimension.name + " could be measured by " + found->name +
                  " or " + variable.name + "; give it a coordinate variable of its own name");
    }
    found = &variable;
  }
  return found;
}

void require_monotonic(const NetcdfFile& file, const CoordinateAxis& axis) {
  const std::vector<double>& a = axis.values;
  if (a.size() < 2) return;
  const bool ascending = a[1] > a[0];
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (ascending ? a[i] <= a[i - 1] : a[i] >= a[i - 1]) {
      file.refuse(axis.name + " is not strictly monotonic: " + shortest(a[i]) + " follows " +
                  shortest(a[i - 1]));
    }
  }
}

void read_longitude_latitude(const NetcdfFile& file, CurrentLayout& layout) {
  // A subset across the seam of 0..360 runs 359, 0, 1; it is the same axis as 359, 360, 361.
  std::vector<double>& longitude = layout.x.values;
  for (std::size_t i = 1; i < longitude.size(); ++i) {
    longitude[i] += 360.0 * std::round((longitude[i - 1] - longitude[i]) / 360.0);
  }
  for (const double latitude : layout.y.values) {
    if (std::abs(latitude) > 90.0) {
      file.refuse(layout.y.name + " has a latitude of " + shortest(latitude) + " degrees");
    }
  }
}

double axis_unit_m(const NetcdfFile& file, const NetcdfVariable& variable) {
  const std::string units = file.text(variable, "units");
  const double metres = length_unit_m(units);
  if (metres > 0.0) return metres;
  if (units.empty()) file.refuse("the axis " + variable.name + " has no units; give it m or km");
  file.refuse("the units of the axis " + variable.name + " are \"" + units +
              "\"; shoal reads m and km");
}

void read_depth(const NetcdfFile& file, const NetcdfVariable& variable, CoordinateAxis& axis) {
  const std::string name = file.text(variable, "standard_name");
  const std::string positive = file.text(variable, "positive");
  if (name.starts_with("ocean_") || name.find("sigma") != std::string::npos) {
    file.refuse("the levels of " + variable.name +
                " follow the sea floor, which shoal does not read; interpolate them to depths");
  }
  double sign = 1.0;
  if (positive == "up" || (positive.empty() && is_one_of(name, {"height", "altitude"}))) {
    sign = -1.0;
  } else if (positive != "down" && !(positive.empty() && name == "depth")) {
    file.refuse("the axis " + variable.name +
                " does not say which way is positive; give it the "
                "attribute positive = \"down\" or \"up\"");
  }
  const double metres = sign * axis_unit_m(file, variable);
  for (double& value : axis.values) value = value * metres + 0.0;  // not -0
}

void read_time(const NetcdfFile& file, const NetcdfVariable& variable, CoordinateAxis& axis,
               CurrentLayout& layout) {
  const std::string units = file.text(variable, "units");
  if (units.empty()) {
    file.refuse("the axis " + variable.name +
                " has no units; give it the like of \"seconds since 2014-12-01 00:00:00\"");
  }
  try {
    layout.calendar = calendar_named(file.text(variable, "calendar"));
    const TimeUnits parsed = parse_time_units(units, layout.calendar);
    if (axis.values.empty()) file.refuse(variable.name + " holds no time step");
    const double first = axis.values.front();
    layout.first_time = parsed.reference.plus(first * parsed.seconds);
    for (double& value : axis.values) {
      require_date(parsed.reference.plus(value * parsed.seconds), layout.calendar);
      value = (value - first) * parsed.seconds;
    }
  } catch (const InputError& error) {
    const std::string why = error.what();
    if (why.starts_with(file.name() + ": ")) throw;
    file.refuse(variable.name + ": " + why);
  }
  for (std::size_t i = 1; i < axis.values.size(); ++i) {
    if (axis.values[i] <= axis.values[i - 1]) {
      file.refuse(variable.name + " does not increase: " +
                  iso_text(layout.first_time.plus(axis.values[i]), layout.calendar) + " follows " +
                  iso_text(layout.first_time.plus(axis.values[i - 1]), layout.calendar));
    }
  }
}

void refuse_without_axes(const NetcdfFile& file, const CurrentLayout& layout) {
  const bool staggered = layout.u.dimensions != layout.v.dimensions;
  const std::string pair = dimensions_text(layout.u) + " and " + dimensions_text(layout.v);
  bool curvilinear = false;
  for (const std::size_t back : {1u, 2u}) {
    const auto& dimensions = layout.u.dimensions;
    curvilinear |= !coordinate_of(file, dimensions[dimensions.size() - back]);
  }
  if (!staggered && !curvilinear) return;
  const std::string what =
      staggered ? pair + " stand on different points: a staggered (Arakawa C) grid" +
                      (curvilinear ? ", and a curvilinear one, without 1-D axes" : "")
                : dimensions_text(layout.u) +
                      " stands on a curvilinear grid: " + layout.u.dimensions.back().name + " or " +
                      layout.u.dimensions[layout.u.dimensions.size() - 2].name +
                      " has no 1-D coordinate variable";
  file.refuse(what +
              "; shoal reads currents on common points with regular longitude/latitude or "
              "projected x/y axes, so regrid them first");
}

void take_axis(const NetcdfFile& file, const NetcdfVariable& variable, AxisRole role,
               std::optional<std::size_t> position, CurrentLayout& layout) {
  CoordinateAxis axis{variable.name, position.value_or(0), position.has_value(),
                      complete_values(file, variable)};
  switch (role) {
    case AxisRole::longitude:
    case AxisRole::x:
      if (role == AxisRole::x) {
        for (double& value : axis.values) value *= axis_unit_m(file, variable);
      }
      layout.kind = role == AxisRole::x ? AxisKind::projected : AxisKind::longitude_latitude;
      layout.x = std::move(axis);
      break;
    case AxisRole::latitude:
    case AxisRole::y:
      if (role == AxisRole::y) {
        for (double& value : axis.values) value *= axis_unit_m(file, variable);
      }
      layout.y = std::move(axis);
      break;
    case AxisRole::depth:
      read_depth(file, variable, axis);
      layout.depth = std::move(axis);
      break;
    case AxisRole::time:
      read_time(file, variable, axis, layout);
      layout.time = std::move(axis);
      break;
    case AxisRole::none:
      break;
  }
}

void read_axes(const NetcdfFile& file, CurrentLayout& layout) {
  const auto& dimensions = layout.u.dimensions;
  std::vector<AxisRole> roles;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    const NetcdfVariable* variable = coordinate_of(file, dimensions[d]);
    const AxisRole role = variable ? role_of(file, *variable) : AxisRole::none;
    if (role == AxisRole::none) {
      file.refuse("the dimension " + dimensions[d].name + " of " + dimensions_text(layout.u) +
                  (variable ? " is neither time, depth nor a horizontal axis, by the units and "
                              "standard name of its coordinate variable"
                            : " has no coordinate variable that says what it is"));
    }
    if (dimensions[d].length == 0) {
      file.refuse("the dimension " + dimensions[d].name + " has length 0");
    }
    roles.push_back(role);
    take_axis(file, *variable, role, d, layout);
  }

  const std::size_t last = roles.size() - 1;
  const bool lon_lat = roles[last] == AxisRole::longitude && roles[last - 1] == AxisRole::latitude;
  const bool projected = roles[last] == AxisRole::x && roles[last - 1] == AxisRole::y;
  const std::vector<AxisRole> above(roles.begin(), roles.end() - 2);
  const bool ordered = above.empty() || above == std::vector{AxisRole::time} ||
                       above == std::vector{AxisRole::depth} ||
                       above == std::vector{AxisRole::time, AxisRole::depth};
  if (!(lon_lat || projected) || !ordered) {
    file.refuse(dimensions_text(layout.u) +
                " does not have its dimensions in the order time, depth, y, x; reorder them");
  }
}

/// A depth or time that holds for the whole field, named in the attribute `coordinates`.
void read_scalar_coordinates(const NetcdfFile& file, CurrentLayout& layout) {
  const std::string coordinates = file.text(layout.u, "coordinates");
  for (const std::string_view name : split(coordinates, ' ')) {
    const NetcdfVariable* variable = file.find(name);
    if (!variable || !variable->dimensions.empty()) continue;
    const AxisRole role = role_of(file, *variable);
    if ((role == AxisRole::depth && !layout.depth) || (role == AxisRole::time && !layout.time)) {
      take_axis(file, *variable, role, std::nullopt, layout);
    }
  }
}

/// Longitude and latitude of the nodes of a projected grid, from 2-D or 1-D auxiliary coordinates.
std::optional<NodePositions> node_positions(const NetcdfFile& file, const CurrentLayout& layout) {
  const auto& dimensions = layout.u.dimensions;
  const NetcdfDimension& along_x = dimensions[layout.x.position];
  const NetcdfDimension& along_y = dimensions[layout.y.position];
  const std::size_t nx = along_x.length, ny = along_y.length;
  NodePositions positions;
  for (const NetcdfVariable& variable : file.variables()) {
    const bool full = variable.dimensions == std::vector{along_y, along_x};
    const bool one = variable.dimensions.size() == 1 &&
                     (variable.dimensions[0] == along_x || variable.dimensions[0] == along_y);
    if (!full && !one) continue;
    const AxisRole role = role_of(file, variable);
    if (role != AxisRole::longitude && role != AxisRole::latitude) continue;
    auto& values = role == AxisRole::longitude ? positions.longitude : positions.latitude;
    if (!values.empty()) return std::nullopt;  // two of them: none is the obvious one
    values = complete_values(file, variable);
    if (full) continue;
    std::vector<double> spread(nx * ny);
    for (std::size_t k = 0; k < spread.size(); ++k) {
      spread[k] = values[variable.dimensions[0] == along_x ? k % nx : k / nx];
    }
    values = std::move(spread);
  }
  if (positions.longitude.empty() || positions.latitude.empty()) return std::nullopt;
  return positions;
}

std::vector<bool> land_mask(const NetcdfFile& file, const CurrentLayout& layout) {
  const auto& dimensions = layout.u.dimensions;
  for (const NetcdfVariable& variable : file.variables()) {
    const std::string name = file.text(variable, "standard_name");
    const bool roms =
        file.text(variable, "option_0") == "land" && file.text(variable, "option_1") == "water";
    if (!is_one_of(name, {"sea_binary_mask", "land_binary_mask"}) && !roms) continue;
    const std::vector horizontal{dimensions[layout.y.position], dimensions[layout.x.position]};
    if (variable.dimensions != horizontal) {
      if (roms) continue;  // a mask of the other points of a staggered grid
      file.refuse("the mask " + dimensions_text(variable) + " is not on the points of " +
                  dimensions_text(layout.u));
    }
    const double land_value = name == "land_binary_mask" ? 1.0 : 0.0;
    std::vector<bool> land;
    for (const double value : complete_values(file, variable)) land.push_back(value == land_value);
    return land;
  }
  return {};
}

}  // namespace

double bytes_of_a_slab(const NetcdfFile& file, const CurrentLayout& layout) {
  const std::vector<NetcdfDimension>& dimensions = layout.u.dimensions;
  // Both velocities as numbers, the nodes of two levels, positions, and a copy of coordinates.
  constexpr double per_point = 2 * 8 + 2 * 8 + 2 * 8 + 2 * 8;
  constexpr double per_coordinate = 4 * 8;
  double points = 1.0, coordinates = 0.0;
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    const auto length = static_cast<double>(dimensions[d].length);
    if (d + 2 >= dimensions.size()) points *= length;
    coordinates += length;
  }
  return per_point * points + per_coordinate * coordinates +
         std::max(file.bytes_beside(layout.u), file.bytes_beside(layout.v));
}

CurrentLayout understand(const NetcdfFile& file, const std::string& u_name,
                         const std::string& v_name) {
  const VelocityPair pair = find_velocities(file, u_name, v_name);
  CurrentLayout layout{.u = *pair.u, .v = *pair.v};
  for (const NetcdfVariable* variable : {pair.u, pair.v}) {
    if (variable->dimensions.size() < 2) {
      file.refuse(dimensions_text(*variable) + " has no two horizontal dimensions");
    }
  }
  file.require_room(bytes_of_a_slab(file, layout));
  refuse_without_axes(file, layout);
  layout.u_units = file.text(layout.u, "units");
  layout.v_units = file.text(layout.v, "units");
  layout.u_unit_m_s = velocity_unit_m_s(file, layout.u);
  layout.v_unit_m_s = velocity_unit_m_s(file, layout.v);

  read_axes(file, layout);
  read_scalar_coordinates(file, layout);
  if (layout.kind == AxisKind::longitude_latitude) {
    read_longitude_latitude(file, layout);
  } else {
    layout.positions = node_positions(file, layout);
  }
  for (const CoordinateAxis* axis : {&layout.x, &layout.y}) {
    require_monotonic(file, *axis);
    if (axis->values.size() < 2) {
      file.refuse("the axis " + axis->name + " has a single point; a field needs at least two");
    }
  }
  if (layout.depth) require_monotonic(file, *layout.depth);

  // Longitude and latitude axes run east and north, so there both readings are one.
  if (layout.kind == AxisKind::projected && !pair.components && layout.positions) {
    file.refuse(layout.u.name + " and " + layout.v.name +
                " do not say whether they point east and north or along the projected axes; give "
                "them a standard_name");
  }
  layout.components = layout.kind == AxisKind::longitude_latitude
                          ? Components::east_north
                          : pair.components.value_or(Components::grid_axes);
  layout.land = land_mask(file, layout);
  return layout;
}

}  // namespace shoal::scenarios
