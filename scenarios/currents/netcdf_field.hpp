#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "shoal/scenarios/currents/netcdf_axis.hpp"

namespace shoal::scenarios {

/// Velocities (m/s) on the nodes of a rectangular grid and at some times; immutable.
///
/// Between the nodes it is bilinear in space and linear in time, over wet corners only: the weights
/// of missing corners are dropped and the others brought to a sum of one, so that neither land
/// nor a fill value bleeds into the water.
class VelocityField {
 public:
  /// Both NaN where there is no water. In float: the rounding, 1e-8 m/s, is far below any file's.
  struct Node {
    float u, v;
  };

  /// Axes in metres, times in seconds, ascending; one time stands for a field that lasts.
  /// nodes[(t * y.size() + j) * x.size() + i].
  VelocityField(std::vector<double> x_m, std::vector<double> y_m, std::vector<double> times_s,
                std::vector<Node> nodes);

  const GridAxis& x() const { return x_; }
  const GridAxis& y() const { return y_; }
  bool steady() const { return !time_; }
  double last_time_s() const { return time_ ? time_->last() : 0.0; }

  /// Whether no node has a velocity at a time, which is clamped to those of the data.
  bool dry(double time_s) const;

  /// Velocities at positions of the mission's frame, which `grid_from_mission` takes to the grid's,
  /// at a time within the data (any, if steady). With `clamp`, positions outside take the nearest
  /// point of the grid, positions on land the nearest wet node.
  ///
  /// Returns the first position that has no velocity, or the number of positions.
  std::size_t sample(double time_s, const Eigen::Matrix2d& grid_from_mission, bool clamp,
                     std::span<const double> x_m, std::span<const double> y_m,
                     std::span<double> u_m_s, std::span<double> v_m_s) const;

 private:
  struct Bracket {
    const Node* before;
    const Node* after;
    double fraction;  ///< 0 at `before`, 1 at `after`
  };

  Bracket bracket(double time_s) const;
  /// The velocity of one node; NaN if it is missing at a time that is needed.
  Eigen::Vector2d at_node(const Bracket& when, std::size_t index) const;
  std::optional<Eigen::Vector2d> over_wet_corners(const Bracket& when, const GridAxis::Place& i,
                                                  const GridAxis::Place& j) const;
  /// For positions near or on land, or outside the grid.
  std::optional<Eigen::Vector2d> off_the_fast_path(const Bracket& when, bool clamp, double x_m,
                                                   double y_m) const;
  std::optional<Eigen::Vector2d> nearest_wet(const Bracket& when, double x_m, double y_m) const;

  GridAxis x_, y_;
  std::optional<GridAxis> time_;
  std::vector<Node> nodes_;
};

}  // namespace shoal::scenarios
