#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace shoal::scenarios {

/// Finds the cell of a strictly ascending axis that a coordinate lies in, in constant time for
/// equidistant axes, and for others by a table that leads to within a few nodes of the cell.
class GridAxis {
 public:
  struct Place {
    std::size_t cell = 0;   ///< between nodes `cell` and `cell + 1`
    double fraction = 0.0;  ///< 0 at the lower node, 1 at the upper
  };

  /// At least two strictly ascending nodes.
  explicit GridAxis(std::vector<double> nodes) : nodes_(std::move(nodes)) {
    const auto cells = static_cast<double>(nodes_.size() - 1);
    const double spacing = (nodes_.back() - nodes_.front()) / cells;
    double narrowest = spacing;
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      const double nominal = nodes_.front() + static_cast<double>(i) * spacing;
      equidistant_ = equidistant_ && std::abs(nodes_[i] - nominal) <= slack * spacing;
      narrowest = std::min(narrowest, nodes_[i + 1] - nodes_[i]);
    }
    first_ = nodes_.front();
    last_cell_ = static_cast<std::ptrdiff_t>(nodes_.size()) - 2;
    if (equidistant_) {
      inverse_ = 1.0 / spacing;
      highest_ = cells + slack;
      return;
    }
    // One bucket for each of the narrowest cells, within reason.
    const double buckets = std::min(std::ceil(cells * spacing / narrowest), 16.0 * cells);
    inverse_ = buckets / (nodes_.back() - nodes_.front());
    highest_ = buckets + slack;
    std::ptrdiff_t cell = 0;
    for (double b = 0.0; b <= buckets; b += 1.0) {
      while (cell < last_cell_ && node(cell + 1) <= nodes_.front() + b / inverse_) ++cell;
      first_cell_.push_back(cell);
    }
  }

  const std::vector<double>& nodes() const { return nodes_; }
  double first() const { return first_; }
  double last() const { return nodes_.back(); }

  /// False for coordinates outside the nodes by more than rounding, and for NaN.
  bool locate(double x, Place& place) const {
    const double scaled = (x - first_) * inverse_;
    if (!(scaled >= -slack && scaled <= highest_)) return false;
    if (equidistant_) {
      const auto cell = std::min(static_cast<std::ptrdiff_t>(scaled), last_cell_);
      place = {static_cast<std::size_t>(cell), scaled - static_cast<double>(cell)};
      return true;
    }
    std::ptrdiff_t cell = first_cell_[static_cast<std::size_t>(std::max(scaled, 0.0))];
    while (cell < last_cell_ && x >= node(cell + 1)) ++cell;
    while (cell > 0 && x < node(cell)) --cell;
    place = {static_cast<std::size_t>(cell), (x - node(cell)) / (node(cell + 1) - node(cell))};
    return true;
  }

 private:
  /// Rounding, as a fraction of a cell: what a change of units or a rotation may add to a border.
  static constexpr double slack = 1e-9;

  double node(std::ptrdiff_t i) const { return nodes_[static_cast<std::size_t>(i)]; }

  std::vector<double> nodes_;
  std::vector<std::ptrdiff_t> first_cell_;  ///< of each bucket; empty if equidistant
  double first_ = 0.0;
  double inverse_ = 0.0;  ///< cells, or buckets, per unit
  double highest_ = 0.0;  ///< the last node in these units, and the slack
  std::ptrdiff_t last_cell_ = 0;
  bool equidistant_ = true;
};

}  // namespace shoal::scenarios
