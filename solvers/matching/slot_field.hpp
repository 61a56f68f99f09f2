#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace shoal::solvers {

/// How far it is at least from any place to the nearest slot (m), read from a table: made once per
/// plan, to be asked very often.
class SlotField {
 public:
  /// Finite, at least one.
  explicit SlotField(std::span<const Eigen::Vector2d> slots);

  /// Never more than the true distance, and by the size of a cell less near slots. A place beyond
  /// the table is as far as the nearest place of its edge.
  double distance_at_least(double x, double y) const {
    const auto column = cell((x - left_) * per_cell_, columns_);
    const auto row = cell((y - bottom_) * per_cell_, rows_);
    return static_cast<double>(distance_[row * columns_ + column]);
  }

 private:
  static std::size_t cell(double coordinate, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(coordinate, 0.0, static_cast<double>(count - 1)));
  }

  double left_, bottom_, per_cell_;
  std::size_t columns_, rows_;
  std::vector<float> distance_;  // row by row, from below
};

}  // namespace shoal::solvers
