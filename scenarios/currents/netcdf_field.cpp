#include "shoal/scenarios/currents/netcdf_field.hpp"

#include <limits>

namespace shoal::scenarios {
namespace {

using Eigen::Vector2d;

/// Two neighbouring nodes of a row: u, v, u, v.
using NodePair = Eigen::Map<const Eigen::Array4f>;

/// Calls `visit` with the nodes below `reach` away from `x`, from the closest outwards on each
/// side. `reach` may shrink on the way.
template <class Visit>
void outwards(const std::vector<double>& nodes, double x, const double& reach, Visit visit) {
  const auto upper = std::ranges::lower_bound(nodes, x) - nodes.begin();
  std::ptrdiff_t low = upper - 1, high = upper;
  const auto size = static_cast<std::ptrdiff_t>(nodes.size());
  const auto node = [&](std::ptrdiff_t k) { return nodes[static_cast<std::size_t>(k)]; };
  for (;;) {
    const bool go_low = low >= 0 && x - node(low) < reach;
    const bool go_high = high < size && node(high) - x < reach;
    if (!go_low && !go_high) return;
    if (go_low) visit(static_cast<std::size_t>(low--));
    if (go_high) visit(static_cast<std::size_t>(high++));
  }
}

}  // namespace

VelocityField::VelocityField(std::vector<double> x_m, std::vector<double> y_m,
                             std::vector<double> times_s, std::vector<Node> nodes)
    : x_(std::move(x_m)), y_(std::move(y_m)), nodes_(std::move(nodes)) {
  if (times_s.size() > 1) time_.emplace(std::move(times_s));
}

std::size_t VelocityField::sample(double time_s, const Eigen::Matrix2d& grid_from_mission,
                                  bool clamp, std::span<const double> x_m,
                                  std::span<const double> y_m, std::span<double> u_m_s,
                                  std::span<double> v_m_s) const {
  const Bracket when = bracket(time_s);
  const auto after = static_cast<float>(when.fraction);
  const float before = 1.0f - after;
  const std::size_t width = x_.nodes().size();
  const double xx = grid_from_mission(0, 0), xy = grid_from_mission(0, 1);
  const double yx = grid_from_mission(1, 0), yy = grid_from_mission(1, 1);

  for (std::size_t k = 0; k < x_m.size(); ++k) {
    const double x = xx * x_m[k] + xy * y_m[k];
    const double y = yx * x_m[k] + yy * y_m[k];
    GridAxis::Place i, j;
    if (x_.locate(x, i) && y_.locate(y, j)) {
      const std::size_t corner = j.cell * width + i.cell;
      const auto north = static_cast<float>(j.fraction);
      const auto east = static_cast<float>(i.fraction);
      const float* south_before = &when.before[corner].u;
      const float* south_after = &when.after[corner].u;
      const float* north_before = &when.before[corner + width].u;
      const float* north_after = &when.after[corner + width].u;
      const Eigen::Array4f row =
          (1.0f - north) * (before * NodePair(south_before) + after * NodePair(south_after)) +
          north * (before * NodePair(north_before) + after * NodePair(north_after));
      const float u = (1.0f - east) * row[0] + east * row[2];
      const float v = (1.0f - east) * row[1] + east * row[3];
      if (!std::isnan(u)) {  // a missing corner makes it NaN, whatever its weight
        u_m_s[k] = u;
        v_m_s[k] = v;
        continue;
      }
    }
    const std::optional<Vector2d> velocity = off_the_fast_path(when, clamp, x, y);
    if (!velocity) return k;
    u_m_s[k] = velocity->x();
    v_m_s[k] = velocity->y();
  }
  return x_m.size();
}

bool VelocityField::dry(double time_s) const {
  const Bracket when = bracket(time_s);
  const std::size_t nodes = x_.nodes().size() * y_.nodes().size();
  for (std::size_t k = 0; k < nodes; ++k) {
    if (!at_node(when, k).hasNaN()) return false;
  }
  return true;
}

std::optional<Vector2d> VelocityField::off_the_fast_path(const Bracket& when, bool clamp,
                                                         double x_m, double y_m) const {
  if (clamp && std::isfinite(x_m) && std::isfinite(y_m)) {
    x_m = std::clamp(x_m, x_.first(), x_.last());
    y_m = std::clamp(y_m, y_.first(), y_.last());
  }
  GridAxis::Place i, j;
  if (!x_.locate(x_m, i) || !y_.locate(y_m, j)) return std::nullopt;
  std::optional<Vector2d> velocity = over_wet_corners(when, i, j);
  return velocity || !clamp ? velocity : nearest_wet(when, x_m, y_m);
}

VelocityField::Bracket VelocityField::bracket(double time_s) const {
  if (!time_) return {nodes_.data(), nodes_.data(), 0.0};
  GridAxis::Place place;
  time_->locate(std::clamp(time_s, time_->first(), time_->last()), place);
  const std::size_t step = x_.nodes().size() * y_.nodes().size();
  const Node* before = nodes_.data() + place.cell * step;
  return {before, before + step, place.fraction};
}

Vector2d VelocityField::at_node(const Bracket& when, std::size_t index) const {
  const Node& before = when.before[index];
  const Node& after = when.after[index];
  if (when.fraction <= 0.0) return {before.u, before.v};
  if (when.fraction >= 1.0) return {after.u, after.v};
  return (1.0 - when.fraction) * Vector2d(before.u, before.v) +
         when.fraction * Vector2d(after.u, after.v);
}

std::optional<Vector2d> VelocityField::over_wet_corners(const Bracket& when,
                                                        const GridAxis::Place& i,
                                                        const GridAxis::Place& j) const {
  const std::size_t width = x_.nodes().size();
  Vector2d sum = Vector2d::Zero();
  double wet = 0.0;
  for (const std::size_t dj : {0u, 1u}) {
    for (const std::size_t di : {0u, 1u}) {
      const double weight =
          (di ? i.fraction : 1.0 - i.fraction) * (dj ? j.fraction : 1.0 - j.fraction);
      const Vector2d velocity = at_node(when, (j.cell + dj) * width + i.cell + di);
      if (velocity.hasNaN() || weight <= 0.0) continue;
      sum += weight * velocity;
      wet += weight;
    }
  }
  if (wet <= 0.0) return std::nullopt;
  return sum / wet;
}

std::optional<Vector2d> VelocityField::nearest_wet(const Bracket& when, double x_m,
                                                   double y_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<Vector2d> found;
  outwards(y_.nodes(), y_m, nearest, [&](std::size_t j) {
    outwards(x_.nodes(), x_m, nearest, [&](std::size_t i) {
      const double distance = std::hypot(x_.nodes()[i] - x_m, y_.nodes()[j] - y_m);
      if (distance >= nearest) return;
      const Vector2d velocity = at_node(when, j * x_.nodes().size() + i);
      if (velocity.hasNaN()) return;
      nearest = distance;
      found = velocity;
    });
  });
  return found;
}

}  // namespace shoal::scenarios
