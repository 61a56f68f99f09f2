#include "shoal/scenarios/currents/netcdf_waters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <system_error>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/netcdf_layout.hpp"
#include "shoal/scenarios/currents/netcdf_reader.hpp"

namespace shoal::scenarios {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Node = VelocityField::Node;

/// A depth between two levels: value = (1 - fraction) * upper + fraction * lower.
struct Level {
  std::size_t upper = 0, lower = 0;
  double fraction = 0.0;
};

Level level_at(const NetcdfFile& file, const CurrentLayout& layout, const WatersRequest& request) {
  const double depth = request.depth_m;
  if (!layout.depth) {
    if (depth == 0.0 || request.clamp) return {};
    file.refuse(fmt::format("no current at a depth of {} m: the file has no depths; {}",
                            shortest(depth), or_clamp_place));
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
  if (outside && !request.clamp) {
    const auto [top, bottom] = std::ranges::minmax(levels);
    const std::string there =
        levels.size() == 1
            ? fmt::format("the only level is at {} m", shortest(top))
            : fmt::format("the levels run from {} to {} m", shortest(top), shortest(bottom));
    file.refuse(fmt::format("no current at a depth of {} m: {}; set current.netcdf.depth_m, or {}",
                            shortest(depth), there, or_clamp_place));
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

/// NaN where there is no water, which may be all of a level.
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
  return nodes;
}

/// Of the fields: at the depth asked for, and at all levels.
double bytes_held(const CurrentLayout& layout, bool all_levels) {
  const auto length = [](const CoordinateAxis& axis) {
    return static_cast<double>(axis.values.size());
  };
  const double times = layout.time ? length(*layout.time) : 1.0;
  const double fields = 1.0 + (all_levels ? length(*layout.depth) : 0.0);
  return sizeof(Node) * fields * times * length(layout.x) * length(layout.y);
}

std::shared_ptr<const Waters> read(const NetcdfFile& file, const WatersRequest& request) {
  const CurrentLayout layout = understand(file, request.u_variable, request.v_variable);
  const bool all_levels = request.all_levels && layout.depth && layout.depth->values.size() > 1;
  file.require_room(bytes_of_a_slab(file, layout) + bytes_held(layout, all_levels));
  const MissionFrame frame = mission_frame(file, layout, request.origin);
  const auto field_of = [&](std::vector<Node> nodes) {
    return VelocityField(frame.x_m, frame.y_m,
                         layout.time ? layout.time->values : std::vector<double>{0.0},
                         std::move(nodes));
  };
  std::vector<Node> nodes = read_nodes(file, layout, frame, level_at(file, layout, request));
  const bool dry = std::ranges::all_of(nodes, [](const Node& node) { return std::isnan(node.u); });
  if (dry) file.refuse("holds no current: every value is missing");
  Waters waters{file.name(),
                layout.time ? layout.time->values.size() : 0,
                layout.calendar,
                layout.first_time,
                frame,
                field_of(std::move(nodes)),
                {},
                {}};
  if (all_levels) {
    std::vector<std::size_t> order(layout.depth->values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return layout.depth->values[k]; });
    for (const std::size_t k : order) {
      waters.depths_m.push_back(layout.depth->values[k]);
      waters.levels.push_back(field_of(read_nodes(file, layout, frame, {k, k, 0.0})));
    }
  }
  return std::make_shared<const Waters>(std::move(waters));
}

/// What was read, for which option, and from which state of the file.
struct Known {
  WatersRequest request;
  fs::file_time_type changed;
  std::uintmax_t size;
  std::weak_ptr<const Waters> waters;
};

}  // namespace

void Waters::refuse(const std::string& why) const {
  throw InputError(name + ": " + why);
}

std::shared_ptr<const Waters> waters_of(const WatersRequest& request) {
  static std::mutex mutex;
  static std::vector<Known> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const Known& each) { return each.waters.expired(); });

  std::error_code missing;  // reading it says so better
  const fs::file_time_type changed = fs::last_write_time(request.file, missing);
  const std::uintmax_t size = fs::file_size(request.file, missing);
  for (const Known& each : known) {
    if (each.changed != changed || each.size != size || each.request != request) continue;
    if (std::shared_ptr<const Waters> waters = each.waters.lock()) return waters;
  }
  std::shared_ptr<const Waters> waters =
      read_netcdf(request.file, [&](const NetcdfFile& file) { return read(file, request); });
  known.push_back({request, changed, size, waters});
  return waters;
}

}  // namespace shoal::scenarios
