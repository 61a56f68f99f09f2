#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace shoal {

/// Points of the plane sorted into square cells, to find all within a distance of one of them.
///
/// The work per query depends on the points nearby, not on the size of the swarm. Cells are hashed
/// into as many buckets as there are points, so any extent costs the same memory. Rebuilding
/// allocates only when the number of points grows.
class GridIndex {
 public:
  /// `cell_m`, above 0, should be about the query distance. Points must be finite.
  void build(std::span<const double> x, std::span<const double> y, double cell_m);

  /// Calls `visit(i)` for every point that may lie within one cell size of (x, y): a superset,
  /// each point once, in an order that depends on the points alone.
  template <class Visit>
  void near(double x, double y, Visit&& visit) const;

 private:
  // Points too far away for the integers share the outermost cells, which stay neighbours.
  std::int64_t cell(double v) const {
    return static_cast<std::int64_t>(std::clamp(std::floor(v / cell_m_), -0x1p62, 0x1p62));
  }
  std::size_t bucket(std::int64_t column, std::int64_t row) const {
    const auto hash = static_cast<std::uint64_t>(column) * 0x9E3779B97F4A7C15ull ^
                      static_cast<std::uint64_t>(row) * 0xC2B2AE3D27D4EB4Full;
    return static_cast<std::size_t>((hash ^ (hash >> 29)) % buckets_);
  }

  double cell_m_ = 1.0;
  std::size_t buckets_ = 1;
  std::vector<std::uint32_t> first_ = {0, 0};  // of each bucket, in members_
  std::vector<std::uint32_t> members_;
  std::vector<std::int64_t> column_, row_;  // of each point
};

template <class Visit>
void GridIndex::near(double x, double y, Visit&& visit) const {
  const std::int64_t column = cell(x);
  const std::int64_t row = cell(y);
  for (std::int64_t r = row - 1; r <= row + 1; ++r) {
    for (std::int64_t c = column - 1; c <= column + 1; ++c) {
      const std::size_t b = bucket(c, r);
      for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) {
        const std::uint32_t i = members_[k];
        if (column_[i] == c && row_[i] == r) visit(i);
      }
    }
  }
}

}  // namespace shoal
