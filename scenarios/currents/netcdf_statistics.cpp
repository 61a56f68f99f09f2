#include "shoal/scenarios/currents/netcdf_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/scenarios/currents/netcdf_layout.hpp"

namespace shoal::scenarios {
namespace {

Setting number(double value) {
  Setting setting;
  setting.value = value;
  return setting;
}

double middle_of(const CoordinateAxis& axis) {
  return 0.5 * (axis.values.front() + axis.values.back());
}

bool holds_zero(const CoordinateAxis& axis) {
  const auto [low, high] = std::ranges::minmax(axis.values);
  return low < 0.0 && 0.0 < high;
}

/// The options of the file's current, and how long the window can look at it.
struct FileCurrent {
  Setting options;
  double duration_s = 0.0;
};

FileCurrent placed(const NetcdfFile& file, const std::filesystem::path& path,
                   const DriftingWindow& window) {
  const CurrentLayout layout = understand(file, "", "");
  FileCurrent placed{.duration_s = window.duration_s};
  placed.options.at_or_new("file").value = path.string();
  if (layout.kind == AxisKind::longitude_latitude) {
    Setting point, origin;
    point.value = Setting::List{number(middle_of(layout.x)), number(middle_of(layout.y))};
    origin.value = Setting::List{point};
    placed.options.at_or_new("origin") = origin;
  } else if (!holds_zero(layout.x) || !holds_zero(layout.y)) {
    placed.options.at_or_new("origin_x_m") = number(middle_of(layout.x));
    placed.options.at_or_new("origin_y_m") = number(middle_of(layout.y));
  }
  if (layout.depth) {
    placed.options.at_or_new("depth_m") = number(std::ranges::min(layout.depth->values));
  }
  if (layout.time) {
    const double lasts_s = layout.time->values.back();
    if (lasts_s < window.step_s) file.refuse("lasts too short a time to tell how it changes");
    placed.duration_s =
        std::min(window.duration_s, window.step_s * std::floor(lasts_s / window.step_s));
  }
  return placed;
}

}  // namespace

std::vector<CurrentStatistic> current_file_statistics(const std::filesystem::path& path) {
  DriftingWindow window;
  // The file is closed again before its current reads it.
  const FileCurrent file =
      read_netcdf(path, [&](const NetcdfFile& read) { return placed(read, path, window); });
  window.duration_s = file.duration_s;
  const auto current = Registry<Current>::instance().make("netcdf", file.options, "current.netcdf");
  return current_statistics(*current, window);
}

}  // namespace shoal::scenarios
