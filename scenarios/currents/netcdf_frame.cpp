#include "shoal/scenarios/currents/netcdf_frame.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "shoal/core/angles.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Beyond, the meridians converge too fast for a flat frame.
constexpr double highest_latitude_deg = 89.0;

/// 35.45 E, in [-180, 180).
std::string longitude_text(double degrees) {
  const double wrapped_deg = std::remainder(degrees, 360.0);
  return fmt::format("{:.4f} {}", std::abs(wrapped_deg), wrapped_deg < 0.0 ? "W" : "E");
}

std::string latitude_text(double degrees) {
  return fmt::format("{:.4f} {}", std::abs(degrees), degrees < 0.0 ? "S" : "N");
}

std::string range_text(const std::vector<double>& longitude, const std::vector<double>& latitude) {
  const auto [west, east] = std::ranges::minmax(longitude);
  const auto [south, north] = std::ranges::minmax(latitude);
  return fmt::format("longitude {} to {} and latitude {} to {}", longitude_text(west),
                     longitude_text(east), latitude_text(south), latitude_text(north));
}

/// Nodes in ascending order, and where they come from.
void sort_axis(const std::vector<double>& values, std::vector<double>& nodes,
               std::vector<std::size_t>& order) {
  order.resize(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  for (const std::size_t i : order) nodes.push_back(values[i]);
}

/// Degrees east of the origin, such that the axis runs past it if it can: 0..360 and -180..180
/// are the same longitudes, and an axis all around the Earth has no end beside the origin.
std::vector<double> degrees_east_of(double origin_deg, std::vector<double> longitude) {
  const auto [west, east] = std::ranges::minmax(longitude);
  const double spacing = (east - west) / static_cast<double>(longitude.size() - 1);
  const bool closed = std::abs(east - west - 360.0) < 0.1 * spacing;
  if (closed) longitude.pop_back();  // the first meridian once more
  const bool all_around = closed || std::abs(east - west + spacing - 360.0) < 0.1 * spacing;
  const double middle = 0.5 * (west + east);
  const double turns = 360.0 * std::round((middle - origin_deg) / 360.0);
  for (double& degrees : longitude) {
    degrees =
        all_around ? std::remainder(degrees - origin_deg, 360.0) : degrees - origin_deg - turns;
  }
  return longitude;
}

void require_usable(const NetcdfFile& file, const Vector2d& origin) {
  if (std::abs(origin.y()) > highest_latitude_deg) {
    file.refuse(
        fmt::format("the origin at latitude {} lies too near a pole for a frame of east "
                    "and north; keep within {} degrees",
                    origin.y(), highest_latitude_deg));
  }
}

MissionFrame on_longitude_latitude(const NetcdfFile& file, const CurrentLayout& layout,
                                   const MissionOrigin& origin) {
  if (origin.x_y != Vector2d::Zero()) {
    file.refuse(
        "the axes are longitude and latitude, where origin_x_m and origin_y_m mean nothing"
        "; set current.netcdf.origin");
  }
  if (!origin.longitude_latitude) {
    file.refuse(
        "the axes are longitude and latitude, so the mission needs an origin; set "
        "current.netcdf.origin = [[LON, LAT]] within " +
        range_text(layout.x.values, layout.y.values));
  }
  const Vector2d degrees = *origin.longitude_latitude;
  require_usable(file, degrees);
  const Vector2d metres = metres_per_degree(degrees.y());
  std::vector<double> x = degrees_east_of(degrees.x(), layout.x.values);
  std::vector<double> y = layout.y.values;
  for (double& value : x) value *= metres.x();
  for (double& value : y) value = (value - degrees.y()) * metres.y();
  MissionFrame frame;
  sort_axis(x, frame.x_m, frame.x_order);
  sort_axis(y, frame.y_m, frame.y_order);
  frame.degrees = MissionFrame::Degrees{degrees, metres.cwiseInverse()};
  return frame;
}

/// Nodes of a projected grid as seen from a point of the Earth, in metres east and north.
class NodesFrom {
 public:
  NodesFrom(const Vector2d& origin_deg, const NodePositions& positions, std::size_t width)
      : origin_(origin_deg), positions_(positions), width_(width) {}

  /// Orthographic, so that the meridians' convergence is kept; NaN on the other side of the Earth.
  Vector2d node(std::size_t i, std::size_t j) const {
    const double east = radians(positions_.longitude[j * width_ + i] - origin_.x());
    const double latitude = radians(positions_.latitude[j * width_ + i]);
    const double latitude0 = radians(origin_.y());
    const double up = std::sin(latitude0) * std::sin(latitude) +
                      std::cos(latitude0) * std::cos(latitude) * std::cos(east);
    if (up <= 0.0) return Vector2d::Constant(std::nan(""));
    const double radius = 180.0 / std::numbers::pi;  // degrees of arc
    const Vector2d metres = metres_per_degree(origin_.y());
    const double metres_east = metres.x() / std::cos(latitude0);
    return {radius * metres_east * std::cos(latitude) * std::sin(east),
            radius * metres.y() *
                (std::cos(latitude0) * std::sin(latitude) -
                 std::sin(latitude0) * std::cos(latitude) * std::cos(east))};
  }

 private:
  Vector2d origin_;
  const NodePositions& positions_;
  std::size_t width_;
};

/// A place on the grid: metres of the projection, and east/north metres per metre of the grid.
struct Placed {
  Vector2d x_y;
  Matrix2d east_north_per_grid;
};

/// Where in the cell (i, j) the point lies that the nodes are seen from: the inverse of the
/// bilinear map, by Newton's method. Nothing if it is outside.
std::optional<Placed> place_in_cell(const NodesFrom& seen, const CurrentLayout& layout,
                                    std::size_t i, std::size_t j) {
  const Vector2d a = seen.node(i, j), b = seen.node(i + 1, j);
  const Vector2d c = seen.node(i, j + 1), d = seen.node(i + 1, j + 1);
  Vector2d s(0.5, 0.5);
  Matrix2d slope;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vector2d at =
        (1.0 - s.y()) * ((1.0 - s.x()) * a + s.x() * b) + s.y() * ((1.0 - s.x()) * c + s.x() * d);
    slope.col(0) = (1.0 - s.y()) * (b - a) + s.y() * (d - c);
    slope.col(1) = (1.0 - s.x()) * (c - a) + s.x() * (d - b);
    if (!slope.allFinite() || slope.determinant() == 0.0) return std::nullopt;
    s -= slope.inverse() * at;
  }
  constexpr double rounding = 1e-6;
  if (!(s.minCoeff() >= -rounding && s.maxCoeff() <= 1.0 + rounding)) return std::nullopt;
  const auto& x = layout.x.values;
  const auto& y = layout.y.values;
  slope.col(0) /= x[i + 1] - x[i];
  slope.col(1) /= y[j + 1] - y[j];
  return Placed{{x[i] + s.x() * (x[i + 1] - x[i]), y[j] + s.y() * (y[j + 1] - y[j])}, slope};
}

std::optional<Placed> place(const CurrentLayout& layout, const Vector2d& origin_deg) {
  const std::size_t nx = layout.x.values.size(), ny = layout.y.values.size();
  const NodesFrom seen(origin_deg, *layout.positions, nx);
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t ni = 0, nj = 0;
  for (std::size_t j = 0; j < ny; ++j) {
    for (std::size_t i = 0; i < nx; ++i) {
      const double distance = seen.node(i, j).squaredNorm();
      if (!(distance < nearest)) continue;
      nearest = distance;
      ni = i;
      nj = j;
    }
  }
  for (std::size_t j = nj > 0 ? nj - 1 : 0; j < std::min(nj + 1, ny - 1); ++j) {
    for (std::size_t i = ni > 0 ? ni - 1 : 0; i < std::min(ni + 1, nx - 1); ++i) {
      if (auto placed = place_in_cell(seen, layout, i, j)) return placed;
    }
  }
  return std::nullopt;
}

/// The direction of the grid's x axis at the node nearest to x_y, counter-clockwise from east.
double grid_angle(const CurrentLayout& layout, const Vector2d& x_y) {
  const auto nearest = [](const std::vector<double>& nodes, double value) {
    const auto closest =
        std::ranges::min_element(nodes, {}, [&](double node) { return std::abs(node - value); });
    return static_cast<std::size_t>(closest - nodes.begin());
  };
  const std::size_t nx = layout.x.values.size();
  const std::size_t i = std::min(nearest(layout.x.values, x_y.x()), nx - 2);
  const std::size_t j = nearest(layout.y.values, x_y.y());
  const Vector2d here(layout.positions->longitude[j * nx + i],
                      layout.positions->latitude[j * nx + i]);
  const Vector2d step = NodesFrom(here, *layout.positions, nx).node(i + 1, j) *
                        (layout.x.values[i + 1] > layout.x.values[i] ? 1.0 : -1.0);
  return std::atan2(step.y(), step.x());
}

MissionFrame on_projection(const NetcdfFile& file, const CurrentLayout& layout,
                           const MissionOrigin& origin) {
  MissionFrame frame;
  Vector2d x_y = origin.x_y;
  if (origin.longitude_latitude) {
    const Vector2d degrees = *origin.longitude_latitude;
    if (x_y != Vector2d::Zero()) {
      file.refuse(
          "the origin is given twice; set either current.netcdf.origin or "
          "origin_x_m and origin_y_m");
    }
    if (!layout.positions) {
      file.refuse(
          "has no longitude and latitude of its projected grid, so an origin cannot be "
          "given in them; set current.netcdf.origin_x_m and origin_y_m");
    }
    require_usable(file, degrees);
    const std::optional<Placed> placed = place(layout, degrees);
    if (!placed) {
      file.refuse(fmt::format("the origin at {}, {} lies outside the grid, which covers {}",
                              longitude_text(degrees.x()), latitude_text(degrees.y()),
                              range_text(layout.positions->longitude, layout.positions->latitude)));
    }
    x_y = placed->x_y;
    frame.grid_from_mission = placed->east_north_per_grid.inverse();
    if (layout.components == Components::grid_axes) {
      frame.mission_from_components = placed->east_north_per_grid.colwise().normalized();
    }
    frame.degrees = MissionFrame::Degrees{degrees, metres_per_degree(degrees.y()).cwiseInverse()};
  } else if (layout.components == Components::east_north && layout.positions) {
    const double angle_deg = degrees(grid_angle(layout, x_y));
    if (std::abs(angle_deg) > 0.5) {
      file.refuse(fmt::format(
          "the velocities point east and north, but the axes are turned by {:.1f} degrees; set "
          "current.netcdf.origin, so that the mission's x can be east",
          angle_deg));
    }
  }
  std::vector<double> x = layout.x.values, y = layout.y.values;
  for (double& value : x) value -= x_y.x();
  for (double& value : y) value -= x_y.y();
  sort_axis(x, frame.x_m, frame.x_order);
  sort_axis(y, frame.y_m, frame.y_order);
  return frame;
}

}  // namespace

Vector2d metres_per_degree(double latitude_deg) {
  constexpr double equatorial_radius_m = 6378137.0;  // WGS84
  constexpr double eccentricity_squared = 6.69437999014e-3;
  const double sine = std::sin(radians(latitude_deg));
  const double w = std::sqrt(1.0 - eccentricity_squared * sine * sine);
  const double prime_vertical_m = equatorial_radius_m / w;
  const double meridian_m = equatorial_radius_m * (1.0 - eccentricity_squared) / (w * w * w);
  return {radians(prime_vertical_m * std::cos(radians(latitude_deg))), radians(meridian_m)};
}

MissionFrame mission_frame(const NetcdfFile& file, const CurrentLayout& layout,
                           const MissionOrigin& origin) {
  return layout.kind == AxisKind::longitude_latitude ? on_longitude_latitude(file, layout, origin)
                                                     : on_projection(file, layout, origin);
}

std::string MissionFrame::position_text(double x, double y) const {
  std::string text = fmt::format("x = {:.1f} m, y = {:.1f} m", x, y);
  if (degrees) {
    const Vector2d there = degrees->origin + degrees->per_metre.cwiseProduct(Vector2d(x, y));
    text += " (" + longitude_text(there.x()) + ", " + latitude_text(there.y()) + ")";
  }
  return text;
}

std::string MissionFrame::extent_text() const {
  const bool along_axes = grid_from_mission.isIdentity();
  std::string text = fmt::format("x from {:.1f} to {:.1f} m and y from {:.1f} to {:.1f} m",
                                 x_m.front(), x_m.back(), y_m.front(), y_m.back());
  if (!along_axes) return text + " along the grid's axes from the origin";
  if (degrees) {
    const Vector2d low =
        degrees->origin + degrees->per_metre.cwiseProduct(Vector2d(x_m.front(), y_m.front()));
    const Vector2d high =
        degrees->origin + degrees->per_metre.cwiseProduct(Vector2d(x_m.back(), y_m.back()));
    text += " (" + range_text({low.x(), high.x()}, {low.y(), high.y()}) + ")";
  }
  return text;
}

}  // namespace shoal::scenarios
