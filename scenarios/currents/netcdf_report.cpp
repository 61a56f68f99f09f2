#include "shoal/scenarios/currents/netcdf_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/netcdf_frame.hpp"
#include "shoal/scenarios/currents/netcdf_reader.hpp"

namespace shoal::scenarios {
namespace {

std::string line(std::string_view what, const std::string& text) {
  return fmt::format("  {:<10}{}\n", what, text);
}

/// Six figures are enough to recognise a number.
std::string brief(double number) {
  return fmt::format("{:.6g}", number);
}

/// `0.05`, or `0.05 to 0.07`.
std::string steps_text(const std::vector<double>& values) {
  double least = INFINITY, most = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    least = std::min(least, step);
    most = std::max(most, step);
  }
  // Axes in single precision are not exactly equidistant.
  return most - least <= 1e-3 * most ? brief(most) : brief(least) + " to " + brief(most);
}

std::string axis_text(const CoordinateAxis& axis, std::string_view unit) {
  return fmt::format("{}: {} points from {} to {} {}, step {}", axis.name, axis.values.size(),
                     brief(axis.values.front()), brief(axis.values.back()), unit,
                     steps_text(axis.values));
}

std::string grid_text(const CurrentLayout& layout) {
  const bool projected = layout.kind == AxisKind::projected;
  const std::string_view unit = projected ? "m" : "degrees";
  std::string text =
      line("grid", fmt::format("{}, {} x {} points", projected ? "projected" : "longitude/latitude",
                               layout.x.values.size(), layout.y.values.size()));
  text += line("", axis_text(layout.x, unit));
  text += line("", axis_text(layout.y, unit));
  if (!projected) {
    const double middle = 0.5 * (layout.y.values.front() + layout.y.values.back());
    const Eigen::Vector2d metres = metres_per_degree(middle);
    const auto extent_km = [](const CoordinateAxis& axis, double per_degree) {
      return std::abs(axis.values.back() - axis.values.front()) * per_degree / 1000.0;
    };
    text += line("", fmt::format("about {:.1f} x {:.1f} km; the mission needs an origin in it: "
                                 "current.netcdf.origin",
                                 extent_km(layout.x, metres.x()), extent_km(layout.y, metres.y())));
    return text;
  }
  if (layout.positions) {
    const auto [west, east] = std::ranges::minmax(layout.positions->longitude);
    const auto [south, north] = std::ranges::minmax(layout.positions->latitude);
    text += line("", fmt::format("longitude {} to {}, latitude {} to {} degrees", brief(west),
                                 brief(east), brief(south), brief(north)));
  }
  text += line("", layout.positions
                       ? "the mission's frame is the grid's, not east and north, unless "
                         "current.netcdf.origin is set"
                       : "the mission's frame is the grid's; the file does not say where east is");
  return text;
}

std::string variables_text(const CurrentLayout& layout, const VelocityReader& reader) {
  const auto one = [](const NetcdfVariable& variable, const std::string& units,
                      const Packing& packing, double unit_m_s) {
    const std::string factor = unit_m_s == 1.0 ? "" : fmt::format(" = {} m/s", brief(unit_m_s));
    return fmt::format("{} in {}{}, stored as {}", variable.name, units, factor,
                       packing.text(variable));
  };
  return line("velocity", one(layout.u, layout.u_units, reader.u_packing(), layout.u_unit_m_s)) +
         line("", one(layout.v, layout.v_units, reader.v_packing(), layout.v_unit_m_s)) +
         line("", layout.components == Components::east_north
                      ? "eastward and northward"
                      : "along the grid's x and y axes, not east and north");
}

std::string time_text(const CurrentLayout& layout) {
  if (!layout.time) return line("time", "none: the current lasts unchanged");
  const std::vector<double>& times = layout.time->values;
  const std::string first = iso_text(layout.first_time, layout.calendar);
  if (times.size() == 1) {
    return line("time", "a single one, " + first + ", " + name_of(layout.calendar) + " calendar; " +
                            "needs current.netcdf.outside = \"clamp\"");
  }
  return line("time", fmt::format("{} to {}, {} calendar", first,
                                  iso_text(layout.first_time.plus(times.back()), layout.calendar),
                                  name_of(layout.calendar))) +
         line("", fmt::format("{} steps over {} s, step {} s", times.size(), brief(times.back()),
                              steps_text(times)));
}

std::string depth_text(const CurrentLayout& layout) {
  if (!layout.depth) return line("depth", "none");
  const std::vector<double>& levels = layout.depth->values;
  if (levels.size() == 1) return line("depth", "one level, at " + brief(levels[0]) + " m");
  const auto [top, bottom] = std::ranges::minmax(levels);
  return line("depth",
              fmt::format("{} levels from {} to {} m", levels.size(), brief(top), brief(bottom)));
}

std::string values_text(const NetcdfFile& file, VelocityReader& reader) {
  std::size_t all = 0, wet = 0;
  double slowest = INFINITY, fastest = 0.0, u_sum = 0.0, v_sum = 0.0;
  std::vector<VelocityField::Node> nodes;
  for (std::size_t t = 0; t < reader.times(); ++t) {
    for (std::size_t k = 0; k < reader.levels(); ++k) {
      reader.read(t, k, nodes);
      all += nodes.size();
      for (const VelocityField::Node& node : nodes) {
        if (std::isnan(node.u)) continue;
        ++wet;
        const double speed = std::hypot(node.u, node.v);
        slowest = std::min(slowest, speed);
        fastest = std::max(fastest, speed);
        u_sum += node.u;
        v_sum += node.v;
      }
    }
  }
  if (wet == 0) file.refuse("holds no current: every value is missing");
  const auto n = static_cast<double>(wet);
  const double missing = 100.0 * static_cast<double>(all - wet) / static_cast<double>(all);
  return line("missing", fmt::format("{:.1f} % of {} values", missing, all)) +
         line("speed", fmt::format("{:.3f} to {:.3f} m/s, mean velocity ({:.3f}, {:.3f}) m/s",
                                   slowest, fastest, u_sum / n, v_sum / n));
}

std::string description(const NetcdfFile& file) {
  const CurrentLayout layout = understand(file, "", "");
  VelocityReader reader(file, layout);
  std::string text = file.name() + ": currents\n";
  text += grid_text(layout);
  text += variables_text(layout, reader);
  text += time_text(layout);
  text += depth_text(layout);
  if (!layout.land.empty()) text += line("mask", "land is taken from it, too");
  text += values_text(file, reader);
  return text;
}

}  // namespace

std::string describe_current_file(const std::filesystem::path& path) {
  return read_netcdf(path, description);
}

}  // namespace shoal::scenarios
