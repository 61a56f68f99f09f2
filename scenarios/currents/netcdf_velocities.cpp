#include "shoal/scenarios/currents/netcdf_velocities.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>

#include "shoal/core/lower_case.hpp"
#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

enum class VelocityRole { none, u, v };

struct Meaning {
  VelocityRole role = VelocityRole::none;
  Components components = Components::east_north;
};

/// What a standard name says. Anomalies and parts of the velocity (tidal, Stokes drift, ...) carry
/// more words in their names and are not taken for the current.
Meaning meaning_of(std::string_view standard_name) {
  static constexpr std::array layers{"", "surface_", "surface_geostrophic_", "geostrophic_",
                                     "barotropic_"};
  for (const std::string layer : layers) {
    const auto is = [&](std::initializer_list<const char*> names) {
      return std::ranges::any_of(names,
                                 [&](const char* name) { return standard_name == layer + name; });
    };
    if (is({"eastward_sea_water_velocity"})) return {VelocityRole::u, Components::east_north};
    if (is({"northward_sea_water_velocity"})) return {VelocityRole::v, Components::east_north};
    if (is({"sea_water_x_velocity", "x_sea_water_velocity"})) {
      return {VelocityRole::u, Components::grid_axes};
    }
    if (is({"sea_water_y_velocity", "y_sea_water_velocity"})) {
      return {VelocityRole::v, Components::grid_axes};
    }
  }
  // Not in the CF table, but what ROMS writes.
  if (standard_name == "sea_water_surface_x_velocity")
    return {VelocityRole::u, Components::grid_axes};
  if (standard_name == "sea_water_surface_y_velocity")
    return {VelocityRole::v, Components::grid_axes};
  return {};
}

/// Whether a description in words speaks of something else than the motion of the water.
bool describes_another_thing(const std::string& description) {
  const auto has = [words = lower_case(description)](const char* word) {
    for (std::size_t at = words.find(word); at != std::string::npos;
         at = words.find(word, at + 1)) {
      const bool begins = at == 0 || !std::isalpha(static_cast<unsigned char>(words[at - 1]));
      if (begins) return true;
    }
    return false;
  };
  for (const char* never : {"uncertainty", "error", "deviation", "variance"}) {
    if (has(never)) return true;
  }
  const bool of_water = has("current") || has("sea water") || has("seawater") || has("ocean");
  for (const char* other : {"wind", "ice", "stokes", "wave", "transport", "tid", "stress"}) {
    if (has(other) && !of_water) return true;
  }
  return false;
}

/// What a variable is that is no velocity of the water: `by its standard name, eastward_wind`; ""
/// if nothing speaks against it.
std::string another_thing(const NetcdfFile& file, const NetcdfVariable& variable) {
  const std::string name = file.text(variable, "standard_name");
  if (!name.empty()) {
    return meaning_of(name).role == VelocityRole::none ? "by its standard name, " + name : "";
  }
  const std::string words = file.text(variable, "long_name");
  return describes_another_thing(words) ? "by its long name, \"" + words + '"' : "";
}

std::string named(const std::vector<const NetcdfVariable*>& variables) {
  std::vector<std::string> names;
  for (const NetcdfVariable* variable : variables) names.push_back(variable->name);
  return listed(names);
}

const NetcdfVariable* required(const NetcdfFile& file, const std::string& name) {
  if (const NetcdfVariable* variable = file.find(name)) return variable;
  std::vector<std::string> names;
  for (const NetcdfVariable& variable : file.variables()) names.push_back(variable.name);
  file.refuse("there is no variable \"" + name + '"' + suggestion(name, names));
}

VelocityPair paired(const NetcdfFile& file, const NetcdfVariable* u, const NetcdfVariable* v) {
  const Meaning of_u = meaning_of(file.text(*u, "standard_name"));
  const Meaning of_v = meaning_of(file.text(*v, "standard_name"));
  if (of_u.role == VelocityRole::v || of_v.role == VelocityRole::u) {
    file.refuse(u->name + " and " + v->name +
                " are, by their standard names, the other way round; exchange u_variable and "
                "v_variable");
  }
  if (of_u.role == VelocityRole::none && of_v.role == VelocityRole::none)
    return {u, v, std::nullopt};
  if (of_u.role == VelocityRole::none || of_v.role == VelocityRole::none ||
      of_u.components != of_v.components) {
    file.refuse(u->name + " and " + v->name +
                " are, by their standard names, not two components of one velocity");
  }
  return {u, v, of_u.components};
}

}  // namespace

VelocityPair find_velocities(const NetcdfFile& file, const std::string& u_name,
                             const std::string& v_name) {
  if (!u_name.empty()) return paired(file, required(file, u_name), required(file, v_name));

  std::vector<const NetcdfVariable*> u, v;
  for (const NetcdfVariable& variable : file.variables()) {
    if (!variable.is_numeric || variable.dimensions.size() < 2) continue;
    const Meaning meaning = meaning_of(file.text(variable, "standard_name"));
    if (meaning.role == VelocityRole::u) u.push_back(&variable);
    if (meaning.role == VelocityRole::v) v.push_back(&variable);
  }
  const std::string choose = "; choose with current.netcdf.u_variable and v_variable";
  if (u.size() > 1 || v.size() > 1) {
    file.refuse("the velocity could be " + named(u) + " with " + named(v) + choose);
  }
  if (u.size() == 1 && v.size() == 1) return paired(file, u[0], v[0]);
  if (u.size() + v.size() == 1) {
    file.refuse("of the two components of the velocity only " + named(u.empty() ? v : u) +
                " is there" + choose);
  }

  std::vector<const NetcdfVariable*> foreign;
  static constexpr std::array<std::array<const char*, 2>, 6> common{{{"u", "v"},
                                                                     {"U", "V"},
                                                                     {"uo", "vo"},
                                                                     {"ugos", "vgos"},
                                                                     {"water_u", "water_v"},
                                                                     {"u_sur", "v_sur"}}};
  for (const auto& [u_common, v_common] : common) {
    const NetcdfVariable* first = file.find(u_common);
    const NetcdfVariable* second = file.find(v_common);
    if (!first || !second || first->dimensions.size() < 2) continue;
    // A name like u may be that of a wind, of ice, of a part of the current.
    const bool is_foreign =
        !another_thing(file, *first).empty() || !another_thing(file, *second).empty();
    if (is_foreign) foreign.insert(foreign.end(), {first, second});
    if (is_foreign) continue;
    u.push_back(first);
    v.push_back(second);
  }
  if (u.empty() && !foreign.empty()) {
    const NetcdfVariable* one = another_thing(file, *foreign[0]).empty() ? foreign[1] : foreign[0];
    file.refuse("holds no current: " + one->name + " is, " + another_thing(file, *one) +
                "; if it is meant all the same, name both components in "
                "current.netcdf.u_variable and v_variable");
  }
  if (u.empty()) {
    file.refuse(
        "holds no current: no variables with the standard names eastward_sea_water_velocity and "
        "northward_sea_water_velocity, or their like; name them in current.netcdf.u_variable and "
        "v_variable");
  }
  if (u.size() > 1) file.refuse("the velocity could be " + named(u) + " with " + named(v) + choose);
  return paired(file, u[0], v[0]);
}

double velocity_unit_m_s(const NetcdfFile& file, const NetcdfVariable& variable) {
  static const std::array<std::pair<std::vector<std::string>, double>, 2> lengths{
      {{{"m", "meter", "meters", "metre", "metres"}, 1.0},
       {{"cm", "centimeter", "centimeters", "centimetre", "centimetres"}, 0.01}}};
  const std::string units = file.text(variable, "units");
  for (const auto& [spellings, metres] : lengths) {
    for (const std::string& length : spellings) {
      for (const std::string second : {"s", "sec", "second", "seconds"}) {
        for (const std::string& joined :
             {length + "/" + second, length + " / " + second, length + " per " + second}) {
          if (units == joined) return metres;
        }
        for (const std::string by : {" ", ".", "*"}) {
          for (const std::string power : {"-1", "^-1", "**-1"}) {
            if (units == length + by + second + power) return metres;
          }
        }
      }
    }
  }
  for (const char* knot : {"knot", "knots", "kt", "kts"}) {
    if (units == knot) return 1852.0 / 3600.0;
  }
  if (units.empty()) file.refuse(variable.name + " has no units; give it \"m s-1\"");
  file.refuse("the units of " + variable.name + " are \"" + units +
              "\", not a velocity that shoal knows (m s-1, cm s-1, knots)");
}

}  // namespace shoal::scenarios
