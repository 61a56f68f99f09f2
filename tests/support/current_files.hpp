#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <functional>

#include "shoal/scenarios/currents/current.hpp"
#include "tests/support/netcdf_writer.hpp"

/// Files of currents to try the reader on, written part by part.
namespace shoal::scenarios::current_files {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using tests::NetcdfWriter;
using Values = std::vector<double>;
using Changes = std::vector<std::pair<std::string, Setting>>;

inline constexpr double float_rounding =
    3e-8;  // of velocities below 1 m/s, kept in single precision

template <class T>
Setting plain(T value) {
  Setting setting;
  setting.value = std::move(value);
  return setting;
}

inline Setting origin_at(double longitude, double latitude) {
  return plain(Setting::List{plain(Setting::List{plain(longitude), plain(latitude)})});
}

inline Vector2d linear(double t, double, double x, double y) {
  return {0.05 + 1e-4 * x - 2e-4 * y + 3e-5 * t, -0.1 + 2e-4 * x + 1e-4 * y};
}

/// A file of currents, on projected axes by default; every part can be set.
struct File {
  Values x{0, 100, 200}, y{0, 100, 200, 300}, time{0, 600, 1200}, depth;
  std::string x_units = "m", y_units = "m", x_name = "projection_x_coordinate",
              y_name = "projection_y_coordinate";
  std::string time_units = "seconds since 2014-12-01 00:00:00", calendar;
  std::string positive = "down", depth_units = "m";
  std::string u_name = "eastward_sea_water_velocity", v_name = "northward_sea_water_velocity";
  std::string u_words;  ///< the long name of u; "" for none
  std::string units = "m s-1";
  nc_type type = NC_DOUBLE;
  double scale = 1.0, offset = 0.0;
  /// Velocities in the file's units, at time, depth, x and y of the axes.
  std::function<Vector2d(double, double, double, double)> velocity = linear;
  /// More attributes of both velocities, and more variables, behind all others or before the time.
  std::function<void(NetcdfWriter&)> attributes = [](NetcdfWriter&) {};
  std::function<void(NetcdfWriter&)> variables = [](NetcdfWriter&) {};
  std::function<void(NetcdfWriter&)> before_time = [](NetcdfWriter&) {};

  static File lon_lat(Values longitude, Values latitude) {
    File file;
    file.x = std::move(longitude);
    file.y = std::move(latitude);
    file.x_units = "degrees_east";
    file.y_units = "degrees_north";
    file.x_name = "longitude";
    file.y_name = "latitude";
    file.velocity = [](double, double, double, double) { return Vector2d(0.1, 0.2); };
    return file;
  }

  fs::path write(const std::string& name, int format = NC_64BIT_OFFSET) const;
};

/// A folder of this process alone, gone when it ends.
struct Scratch {
  fs::path folder = fs::path(testing::TempDir()) / ("shoal_netcdf_" + std::to_string(getpid()));
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

inline fs::path scratch(const std::string& name) {
  static const Scratch scratch;
  const fs::path folder =
      scratch.folder / testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(folder);
  return folder / name;
}

inline fs::path File::write(const std::string& name, int format) const {
  const fs::path path = scratch(name);
  NetcdfWriter w(path, format);
  std::vector<std::string> dimensions;
  const auto axis = [&](const std::string& dimension, const Values& values) -> NetcdfWriter& {
    dimensions.push_back(dimension);
    w.dimension(dimension, values.size());
    if (dimension == "time") before_time(w);
    return w.variable(dimension, NC_DOUBLE, {dimension}, values);
  };
  if (!time.empty()) {
    axis("time", time).text("units", time_units);
    if (!calendar.empty()) w.text("calendar", calendar);
  }
  if (!depth.empty()) {
    axis("depth", depth).text("units", depth_units);
    if (!positive.empty()) w.text("positive", positive);
  }
  axis("y", y).text("standard_name", y_name);
  if (!y_units.empty()) w.text("units", y_units);
  axis("x", x).text("standard_name", x_name);
  if (!x_units.empty()) w.text("units", x_units);
  Values u, v;
  for (const double t : time.empty() ? Values{0.0} : time) {
    for (const double z : depth.empty() ? Values{0.0} : depth) {
      for (const double yy : y) {
        for (const double xx : x) {
          const Vector2d value = velocity(t, z, xx, yy);
          const bool integer = type != NC_FLOAT && type != NC_DOUBLE;
          const auto stored = [&](double q) {
            const double packed = (q - offset) / scale;
            return integer ? std::round(packed) : packed;
          };
          u.push_back(stored(value.x()));
          v.push_back(stored(value.y()));
        }
      }
    }
  }
  for (const bool first : {true, false}) {
    w.variable(first ? "u" : "v", type, dimensions, first ? u : v);
    const std::string& meaning = first ? u_name : v_name;
    if (!meaning.empty()) w.text("standard_name", meaning);
    if (first && !u_words.empty()) w.text("long_name", u_words);
    if (!units.empty()) w.text("units", units);
    if (scale != 1.0) w.number("scale_factor", NC_DOUBLE, {scale});
    if (offset != 0.0) w.number("add_offset", NC_DOUBLE, {offset});
    attributes(w);
  }
  variables(w);
  w.finish();
  return path;
}

inline std::unique_ptr<Current> open(const fs::path& path, const Changes& options = {}) {
  Setting table;
  table.at_or_new("file").value = path.string();
  for (const auto& [name, value] : options) table.at_or_new(name) = value;
  return Registry<Current>::instance().make("netcdf", table, "current.netcdf");
}

inline Vector2d at(const Current& water, double time, double x, double y) {
  Vector2d velocity(-99.0, -99.0);
  water.sample(time, {&x, 1}, {&y, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
  return velocity;
}

/// The message of the InputError that this throws, "" if it throws none.
inline std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string refusal(const fs::path& path, const Changes& options = {}) {
  return complaint([&] { open(path, options); });
}

#define EXPECT_SAYS(message, part) \
  EXPECT_NE(std::string(message).find(part), std::string::npos) << (message)

inline const Setting clamp = plain(std::string("clamp"));
inline const Setting clamp_place = plain(std::string("clamp_place"));

/// 1 m/s everywhere but for the node (100, 100), which is missing.
inline File with_hole(double stored_hole) {
  File file;
  file.velocity = [stored_hole](double, double, double x, double y) {
    return x == 100 && y == 100 ? Vector2d(stored_hole, stored_hole) : Vector2d(1.0, 1.0);
  };
  return file;
}

}  // namespace shoal::scenarios::current_files
