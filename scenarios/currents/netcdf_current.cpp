#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/current.hpp"
#include "shoal/scenarios/currents/netcdf_field.hpp"
#include "shoal/scenarios/currents/netcdf_frame.hpp"
#include "shoal/scenarios/currents/netcdf_layout.hpp"
#include "shoal/scenarios/currents/netcdf_reader.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Vector2d;
using Node = VelocityField::Node;

enum class Outside { error, clamp };

struct NetcdfOptions {
  FilePath file;
  double time_offset_s = 0.0;
  std::string start;
  std::vector<Vector2d> origin;  ///< longitude, latitude; none or one
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double depth_m = 0.0;
  Outside outside = Outside::error;
  std::string u_variable;
  std::string v_variable;

  static void declare(Options<NetcdfOptions>& o) {
    using N = NetcdfOptions;
    o.file("file", &N::file, "a CF netCDF file with currents on lon/lat or projected x/y axes");
    o.number("time_offset_s", &N::time_offset_s, "s", {},
             "the mission starts this long after the first time in the file, or after `start`");
    o.text("start", &N::start,
           "date at which the mission starts, such as 2014-12-01T00:00:00Z; empty: the first time "
           "in the file");
    o.points("origin", &N::origin,
             "[[LON, LAT]] of the mission's origin; then x is east and y is north", "degrees");
    o.number("origin_x_m", &N::origin_x_m, "m", {}, "the mission's origin on projected axes, x");
    o.number("origin_y_m", &N::origin_y_m, "m", {}, "the mission's origin on projected axes, y");
    o.number("depth_m", &N::depth_m, "m", at_least(0.0),
             "depth of the current, interpolated between the levels of the file");
    o.word("outside", &N::outside, {{"error", Outside::error}, {"clamp", Outside::clamp}},
           "outside the data: an error, or the nearest time, level and wet place");
    o.text("u_variable", &N::u_variable, "name of the eastward component, if it must be chosen");
    o.text("v_variable", &N::v_variable, "name of the northward component, if it must be chosen");
  }

  std::optional<std::string> complaint() const {
    if (file.path.empty()) return "no file is named; set file = \"currents.nc\"";
    if (origin.size() > 1) return "origin has more than one [LON, LAT]";
    if (!origin.empty() && (std::abs(origin[0].x()) > 360.0 || std::abs(origin[0].y()) > 90.0)) {
      return "origin is not [[LON, LAT]] in degrees; the latitude comes second";
    }
    if (u_variable.empty() != v_variable.empty()) {
      return "u_variable and v_variable are named together or not at all";
    }
    return std::nullopt;
  }
};

constexpr const char* or_clamp = "set current.netcdf.outside = \"clamp\"";

/// A depth between two levels: value = (1 - fraction) * upper + fraction * lower.
struct Level {
  std::size_t upper = 0, lower = 0;
  double fraction = 0.0;
};

Level level_at(const NetcdfFile& file, const CurrentLayout& layout, const NetcdfOptions& options) {
  const double depth = options.depth_m;
  if (!layout.depth) {
    if (depth == 0.0 || options.outside == Outside::clamp) return {};
    file.refuse(fmt::format("no current at a depth of {} m: the file has no depths; {}",
                            shortest(depth), or_clamp));
  }
  const std::vector<double>& levels = layout.depth->values;
  Level level;
  double above = -INFINITY, below = INFINITY;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (levels[k] <= depth && levels[k] > above) {
      above = levels[k];
      level.upper = k;
    }
    if (levels[k] >= depth && levels[k] < below) {
      below = levels[k];
      level.lower = k;
    }
  }
  const bool outside = !std::isfinite(above) || !std::isfinite(below);
  if (outside && options.outside == Outside::error) {
    const auto [top, bottom] = std::ranges::minmax(levels);
    const std::string there =
        levels.size() == 1
            ? fmt::format("the only level is at {} m", shortest(top))
            : fmt::format("the levels run from {} to {} m", shortest(top), shortest(bottom));
    file.refuse(fmt::format("no current at a depth of {} m: {}; set current.netcdf.depth_m, or {}",
                            shortest(depth), there, or_clamp));
  }
  if (!std::isfinite(above)) level.upper = level.lower;
  if (!std::isfinite(below)) level.lower = level.upper;
  if (level.upper != level.lower) level.fraction = (depth - above) / (below - above);
  return level;
}

/// The level between two others. A node whose one level lies in the sea floor takes the other.
void blend_levels(std::vector<Node>& upper, const std::vector<Node>& lower, double fraction) {
  const auto w = static_cast<float>(fraction);
  for (std::size_t k = 0; k < upper.size(); ++k) {
    if (std::isnan(upper[k].u)) {
      upper[k] = lower[k];
    } else if (!std::isnan(lower[k].u)) {
      upper[k] = {(1.0f - w) * upper[k].u + w * lower[k].u,
                  (1.0f - w) * upper[k].v + w * lower[k].v};
    }
  }
}

std::vector<Node> read_nodes(const NetcdfFile& file, const CurrentLayout& layout,
                             const MissionFrame& frame, const Level& level) {
  VelocityReader reader(file, layout);
  const std::size_t width = layout.x.values.size();
  std::vector<Node> nodes, slab, lower;
  nodes.reserve(reader.times() * frame.x_order.size() * frame.y_order.size());
  for (std::size_t t = 0; t < reader.times(); ++t) {
    reader.read(t, level.upper, slab);
    if (level.lower != level.upper) {
      reader.read(t, level.lower, lower);
      blend_levels(slab, lower, level.fraction);
    }
    for (const std::size_t j : frame.y_order) {
      for (const std::size_t i : frame.x_order) {
        const Node& node = slab[j * width + i];
        const Vector2d turned = frame.mission_from_components * Vector2d(node.u, node.v);
        nodes.push_back({static_cast<float>(turned.x()), static_cast<float>(turned.y())});
      }
    }
  }
  const bool dry = std::ranges::all_of(nodes, [](const Node& node) { return std::isnan(node.u); });
  if (dry) file.refuse("holds no current: every value is missing");
  return nodes;
}

class NetcdfCurrent final : public Current {
 public:
  static std::unique_ptr<Current> make(const NetcdfOptions& options) {
    const std::filesystem::path path = resolved(options.file);
    try {
      return from_file(path, options);
    } catch (const InputError& error) {
      throw InputError(options.file.origin, error.what());
    }
  }

  void sample(double time_s, std::span<const double> x_m, std::span<const double> y_m,
              std::span<double> u_m_s, std::span<double> v_m_s) const override {
    const bool clamp = outside_ == Outside::clamp;
    if (!clamp) require_time(time_s);
    const std::size_t reached =
        field_.sample(time_s + start_s_, frame_.grid_from_mission, clamp, x_m, y_m, u_m_s, v_m_s);
    if (reached < x_m.size()) refuse_place(time_s, x_m[reached], y_m[reached]);
  }

  void require_duration(double duration_s) const override {
    if (outside_ == Outside::clamp) return;
    require_time(0.0);
    require_time(duration_s);
  }

 private:
  static std::unique_ptr<Current> from_file(const std::filesystem::path& path,
                                            const NetcdfOptions& options) {
    const NetcdfFile file(path);
    const CurrentLayout layout = understand(file, options.u_variable, options.v_variable);
    MissionOrigin origin{.x_y = {options.origin_x_m, options.origin_y_m}};
    if (!options.origin.empty()) origin.longitude_latitude = options.origin.front();
    MissionFrame frame = mission_frame(file, layout, origin);
    const double start_s = start_in_file(file, layout, options);
    VelocityField field(frame.x_m, frame.y_m,
                        layout.time ? layout.time->values : std::vector<double>{0.0},
                        read_nodes(file, layout, frame, level_at(file, layout, options)));
    // Complaints during a trial point at where the file was named.
    return std::unique_ptr<Current>(new NetcdfCurrent(options.file.origin.prefix() + file.name(),
                                                      options.outside, layout, std::move(frame),
                                                      std::move(field), start_s));
  }

  NetcdfCurrent(std::string name, Outside outside, const CurrentLayout& layout, MissionFrame frame,
                VelocityField field, double start_s)
      : name_(std::move(name)),
        outside_(outside),
        calendar_(layout.calendar),
        first_time_(layout.first_time),
        frame_(std::move(frame)),
        field_(std::move(field)),
        start_s_(start_s) {}

  /// Mission start, in seconds since the first time in the file.
  static double start_in_file(const NetcdfFile& file, const CurrentLayout& layout,
                              const NetcdfOptions& options) {
    if (!layout.time) {
      if (options.start.empty() && options.time_offset_s == 0.0) return 0.0;
      file.refuse("has no time axis, so current.netcdf.start and time_offset_s mean nothing");
    }
    const std::string first = iso_text(layout.first_time, layout.calendar);
    if (layout.time->values.size() == 1 && options.outside == Outside::error) {
      file.refuse("holds a single time, " + first +
                  ", and a mission lasts; to use it throughout, " + or_clamp);
    }
    if (options.start.empty()) return options.time_offset_s;
    try {
      return parse_instant(options.start, layout.calendar).since(layout.first_time) +
             options.time_offset_s;
    } catch (const InputError& error) {
      throw InputError("current.netcdf.start: " + std::string(error.what()));
    }
  }

  /// Leaves room for the rounding of a sum of steps.
  void require_time(double time_s) const {
    constexpr double rounding_s = 1e-6;
    if (field_.steady()) return;
    const double in_file = time_s + start_s_;
    const bool late = !(in_file <= field_.last_time_s() + rounding_s);
    if (!late && in_file >= -rounding_s) return;
    const double limit_s = late ? field_.last_time_s() : 0.0;
    std::string reckoned;
    if (start_s_ != 0.0) {
      reckoned = fmt::format(" ({} s {} the offset of {} s)", shortest(limit_s),
                             start_s_ > 0.0 ? "minus" : "plus", shortest(std::abs(start_s_)));
    } else {
      reckoned = fmt::format(" ({} s)", shortest(limit_s));
    }
    throw InputError(fmt::format(
        "{}: no current at t = {} s: the file {} at {}{}; {} or {}", name_, shortest(time_s),
        late ? "ends" : "begins", iso_text(first_time_.plus(limit_s), calendar_), reckoned,
        late ? "shorten trial.duration_s" : "raise current.netcdf.time_offset_s", or_clamp));
  }

  [[noreturn]] void refuse_place(double time_s, double x_m, double y_m) const {
    const Vector2d grid = frame_.grid_from_mission * Vector2d(x_m, y_m);
    const std::string place = frame_.position_text(x_m, y_m);
    GridAxis::Place ignored;
    if (field_.x().locate(grid.x(), ignored) && field_.y().locate(grid.y(), ignored)) {
      const std::string when =
          field_.steady() ? ""
                          : fmt::format(", t = {} s ({})", shortest(time_s),
                                        iso_text(first_time_.plus(time_s + start_s_), calendar_));
      throw InputError(
          fmt::format("{}: no current at {}{}: all nodes around are missing, it is on "
                      "land; move the start, or {}",
                      name_, place, when, or_clamp));
    }
    const std::string along_axes =
        frame_.grid_from_mission.isIdentity()
            ? ""
            : fmt::format(", which is {:.1f} m, {:.1f} m along the grid's axes", grid.x(),
                          grid.y());
    throw InputError(
        fmt::format("{}: no current at {}{}: the file covers {}; shorten "
                    "trial.duration_s, move the start or the origin, or {}",
                    name_, place, along_axes, frame_.extent_text(), or_clamp));
  }

  std::string name_;
  Outside outside_;
  Calendar calendar_;
  Instant first_time_;
  MissionFrame frame_;
  VelocityField field_;
  double start_s_;
};

const Enrol<Current, NetcdfOptions> enrolled{
    "netcdf", "currents from a CF netCDF file, of a model or of observations",
    &NetcdfCurrent::make};

}  // namespace
}  // namespace shoal::scenarios
