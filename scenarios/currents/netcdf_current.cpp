#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/current.hpp"
#include "shoal/scenarios/currents/netcdf_waters.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Vector2d;

enum class Outside { error, clamp_place, clamp };
enum class Depth { vehicle, fixed };

struct NetcdfOptions {
  FilePath file;
  double time_offset_s = 0.0;
  std::string start;
  std::vector<Vector2d> origin;  ///< longitude, latitude; none or one
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  Depth depth = Depth::vehicle;
  double depth_m = 0.0;
  double strength = 1.0;
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
    o.word("depth", &N::depth, {{"vehicle", Depth::vehicle}, {"fixed", Depth::fixed}},
           "a vehicle meets the current of its own depth, or all meet that of depth_m; a file with "
           "one level, or none, is the same at every depth");
    o.number("depth_m", &N::depth_m, "m", at_least(0.0),
             "fixed depth of the current, and the one that maps show, interpolated between the "
             "levels of the file");
    o.number("strength", &N::strength, "", in(0.0, 100.0),
             "the velocities of the file are multiplied by it: what if the current were stronger");
    o.word("outside", &N::outside,
           {{"error", Outside::error},
            {"clamp_place", Outside::clamp_place},
            {"clamp", Outside::clamp}},
           "outside the data: an error; the nearest level and wet place, while a time outside is "
           "an error; or the nearest time, level and wet place");
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

class NetcdfCurrent final : public Current {
 public:
  static std::unique_ptr<Current> make(const NetcdfOptions& options) {
    WatersRequest request{.file = resolved(options.file),
                          .origin = {.x_y = {options.origin_x_m, options.origin_y_m}},
                          .depth_m = options.depth_m,
                          .all_levels = options.depth == Depth::vehicle,
                          .clamp = options.outside != Outside::error,
                          .u_variable = options.u_variable,
                          .v_variable = options.v_variable};
    if (!options.origin.empty()) request.origin.longitude_latitude = options.origin.front();
    try {
      std::shared_ptr<const Waters> waters = waters_of(request);
      const double start_s = start_in_file(*waters, options);
      // Complaints during a trial point at where the file was named.
      std::string name = options.file.origin.prefix() + waters->name;
      return std::unique_ptr<Current>(
          new NetcdfCurrent(std::move(name), options, std::move(waters), start_s));
    } catch (const InputError& error) {
      throw InputError(options.file.origin, error.what());
    }
  }

  void sample(double time_s, std::span<const double> x_m, std::span<const double> y_m,
              std::span<double> u_m_s, std::span<double> v_m_s) const override {
    if (outside_ != Outside::clamp) require_time(time_s);
    const std::size_t reached =
        waters_->field.sample(time_s + start_s_, waters_->frame.grid_from_mission,
                              outside_ != Outside::error, x_m, y_m, u_m_s, v_m_s);
    if (reached < x_m.size()) refuse_place(time_s, x_m[reached], y_m[reached]);
    for (double& u : u_m_s) u *= strength_;
    for (double& v : v_m_s) v *= strength_;
  }

  void sample_at(double time_s, std::span<const double> x_m, std::span<const double> y_m,
                 std::span<const double> depth_m, std::span<double> u_m_s,
                 std::span<double> v_m_s) const override {
    if (waters_->levels.empty()) return sample(time_s, x_m, y_m, u_m_s, v_m_s);
    if (outside_ != Outside::clamp) require_time(time_s);
    for (std::size_t k = 0; k < x_m.size(); ++k) {
      const std::optional<Vector2d> velocity = between_levels(time_s, x_m[k], y_m[k], depth_m[k]);
      if (!velocity) refuse_place(time_s, x_m[k], y_m[k]);
      u_m_s[k] = strength_ * velocity->x();
      v_m_s[k] = strength_ * velocity->y();
    }
  }

  void require_duration(double duration_s) const override {
    if (outside_ == Outside::clamp) return;
    require_time(0.0);
    require_time(duration_s);
  }

 private:
  NetcdfCurrent(std::string name, const NetcdfOptions& options,
                std::shared_ptr<const Waters> waters, double start_s)
      : name_(std::move(name)),
        outside_(options.outside),
        strength_(options.strength),
        waters_(std::move(waters)),
        start_s_(start_s) {}

  /// Linear in depth. Where one level lies in the sea floor it is the other's.
  std::optional<Vector2d> between_levels(double time_s, double x_m, double y_m,
                                         double depth_m) const {
    const std::vector<double>& depths = waters_->depths_m;
    double depth = std::max(0.0, depth_m);  // at most waves are above the surface
    if (outside_ != Outside::error) depth = std::clamp(depth, depths.front(), depths.back());
    if (!(depth >= depths.front() && depth <= depths.back())) refuse_depth(x_m, y_m, depth);
    const auto below = std::ranges::upper_bound(depths, depth) - depths.begin();
    const auto lower = std::min(static_cast<std::size_t>(below), depths.size() - 1);
    const std::size_t upper = lower - 1;
    const double share = (depth - depths[upper]) / (depths[lower] - depths[upper]);
    const auto above_it = at_level(upper, time_s, x_m, y_m);
    const auto below_it = at_level(lower, time_s, x_m, y_m);
    if (!above_it || !below_it) return above_it ? above_it : below_it;
    return (1.0 - share) * *above_it + share * *below_it;
  }

  std::optional<Vector2d> at_level(std::size_t level, double time_s, double x_m, double y_m) const {
    Vector2d velocity;
    const std::size_t found = waters_->levels[level].sample(
        time_s + start_s_, waters_->frame.grid_from_mission, outside_ != Outside::error, {&x_m, 1},
        {&y_m, 1}, {&velocity.x(), 1}, {&velocity.y(), 1});
    return found == 1 ? std::optional(velocity) : std::nullopt;
  }

  /// Mission start, in seconds since the first time in the file.
  static double start_in_file(const Waters& waters, const NetcdfOptions& options) {
    if (waters.times == 0) {
      if (options.start.empty() && options.time_offset_s == 0.0) return 0.0;
      waters.refuse("has no time axis, so current.netcdf.start and time_offset_s mean nothing");
    }
    if (waters.times == 1 && options.outside != Outside::clamp) {
      waters.refuse("holds a single time, " + iso_text(waters.first_time, waters.calendar) +
                    ", and a mission lasts; to use it throughout, " + or_clamp);
    }
    if (options.start.empty()) return options.time_offset_s;
    try {
      return parse_instant(options.start, waters.calendar).since(waters.first_time) +
             options.time_offset_s;
    } catch (const InputError& error) {
      throw InputError("current.netcdf.start: " + std::string(error.what()));
    }
  }

  /// Leaves room for the rounding of a sum of steps.
  void require_time(double time_s) const {
    constexpr double rounding_s = 1e-6;
    if (waters_->field.steady()) return;
    const double in_file = time_s + start_s_;
    const bool late = !(in_file <= waters_->field.last_time_s() + rounding_s);
    if (!late && in_file >= -rounding_s) return;
    const double limit_s = late ? waters_->field.last_time_s() : 0.0;
    std::string reckoned;
    if (start_s_ != 0.0) {
      reckoned = fmt::format(" ({} s {} the offset of {} s)", shortest(limit_s),
                             start_s_ > 0.0 ? "minus" : "plus", shortest(std::abs(start_s_)));
    } else {
      reckoned = fmt::format(" ({} s)", shortest(limit_s));
    }
    throw InputError(fmt::format(
        "{}: no current at t = {} s: the file {} at {}{}; {} or {}", name_, shortest(time_s),
        late ? "ends" : "begins", iso_text(waters_->first_time.plus(limit_s), waters_->calendar),
        reckoned, late ? "shorten trial.duration_s" : "raise current.netcdf.time_offset_s",
        or_clamp));
  }

  [[noreturn]] void refuse_depth(double x_m, double y_m, double depth_m) const {
    throw InputError(fmt::format(
        "{}: no current at a depth of {} m, {}: the levels run from {} to {} m; set "
        "current.netcdf.depth = \"fixed\" with a depth_m in them, or {}",
        name_, shortest(depth_m), waters_->frame.position_text(x_m, y_m),
        shortest(waters_->depths_m.front()), shortest(waters_->depths_m.back()), or_clamp_place));
  }

  /// Whether no node at all has a velocity, at no level.
  bool dry(double time_s) const {
    const double in_file = time_s + start_s_;
    if (waters_->levels.empty()) return waters_->field.dry(in_file);
    return std::ranges::all_of(waters_->levels,
                               [&](const VelocityField& level) { return level.dry(in_file); });
  }

  /// `, t = 60 s (2014-12-01T00:01:00Z)`; "" for a current that lasts unchanged.
  std::string when_text(double time_s) const {
    if (waters_->field.steady()) return "";
    return fmt::format(", t = {} s ({})", shortest(time_s),
                       iso_text(waters_->first_time.plus(time_s + start_s_), waters_->calendar));
  }

  [[noreturn]] void refuse_place(double time_s, double x_m, double y_m) const {
    // The nearest wet node is taken if there is one.
    const bool none_is_wet = outside_ != Outside::error && std::isfinite(x_m) && std::isfinite(y_m);
    if (none_is_wet || dry(time_s)) {
      throw InputError(fmt::format(
          "{}: no current at {}{}: the velocities at that time and depth are all missing; begin or "
          "end the mission where there are some, with current.netcdf.time_offset_s and "
          "trial.duration_s, or complete the file",
          name_, waters_->frame.position_text(x_m, y_m), when_text(time_s)));
    }
    const Vector2d grid = waters_->frame.grid_from_mission * Vector2d(x_m, y_m);
    const std::string place = waters_->frame.position_text(x_m, y_m);
    GridAxis::Place ignored;
    if (waters_->field.x().locate(grid.x(), ignored) &&
        waters_->field.y().locate(grid.y(), ignored)) {
      throw InputError(
          fmt::format("{}: no current at {}{}: all nodes around are missing, it is on "
                      "land; move the start, or {}",
                      name_, place, when_text(time_s), or_clamp_place));
    }
    const std::string along_axes =
        waters_->frame.grid_from_mission.isIdentity()
            ? ""
            : fmt::format(", which is {:.1f} m, {:.1f} m along the grid's axes", grid.x(),
                          grid.y());
    throw InputError(
        fmt::format("{}: no current at {}{}: the file covers {}; shorten "
                    "trial.duration_s, move the start or the origin, or {}",
                    name_, place, along_axes, waters_->frame.extent_text(), or_clamp_place));
  }

  std::string name_;
  Outside outside_;
  double strength_;
  std::shared_ptr<const Waters> waters_;
  double start_s_;
};

const Register<Current, NetcdfOptions> registered{
    "netcdf", "currents from a CF netCDF file, of a model or of observations",
    &NetcdfCurrent::make};

}  // namespace
}  // namespace shoal::scenarios
