#include "shoal/analysis/experiments/measures/lattice_occupation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "shoal/core/grid_index.hpp"

namespace shoal::analysis {
namespace {

// Slots that are next to one another: between a spacing and the diagonal of a square.
constexpr double next_to = 1.2;

std::vector<std::vector<std::size_t>> neighbours(std::span<const Eigen::Vector2d> points,
                                                 double reach_m) {
  std::vector<std::vector<std::size_t>> lists(points.size());
  if (points.size() < 2) return lists;
  std::vector<double> x, y;
  for (const Eigen::Vector2d& p : points) {
    x.push_back(p.x());
    y.push_back(p.y());
  }
  constexpr double least_cell_m = 1e-3;
  GridIndex index;
  index.build(x, y, std::max(reach_m, least_cell_m));
  for (std::size_t i = 0; i < points.size(); ++i) {
    index.near(x[i], y[i], [&](std::size_t j) {
      if (j != i && (points[i] - points[j]).norm() <= reach_m) lists[i].push_back(j);
    });
  }
  return lists;
}

/// Marks all that can be come to from `start` over what is not marked yet; calls `visit` for each.
template <class Visit>
void flood(std::size_t start, const std::vector<std::vector<std::size_t>>& lists,
           std::vector<bool>& marked, Visit&& visit) {
  std::vector<std::size_t> pending = {start};
  marked[start] = true;
  while (!pending.empty()) {
    const std::size_t here = pending.back();
    pending.pop_back();
    visit(here);
    for (const std::size_t next : lists[here]) {
      if (marked[next]) continue;
      marked[next] = true;
      pending.push_back(next);
    }
  }
}

}  // namespace

double least_spacing_m(std::span<const Eigen::Vector2d> points) {
  std::vector<Eigen::Vector2d> by_x(points.begin(), points.end());
  std::ranges::sort(by_x, {}, [](const Eigen::Vector2d& p) { return p.x(); });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < by_x.size(); ++i) {
    for (std::size_t j = i; j-- > 0 && by_x[i].x() - by_x[j].x() < least;) {
      least = std::min(least, (by_x[i] - by_x[j]).norm());
    }
  }
  return least;
}

int groups_within(std::span<const Eigen::Vector2d> points, double reach_m) {
  const auto lists = neighbours(points, reach_m);
  std::vector<bool> marked(points.size());
  int groups = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (marked[i]) continue;
    ++groups;
    flood(i, lists, marked, [](std::size_t) {});
  }
  return groups;
}

int holes(std::span<const Eigen::Vector2d> slots, const std::vector<bool>& taken) {
  const auto lists = neighbours(slots, next_to * least_spacing_m(slots));
  std::size_t most = 0;
  for (const auto& list : lists) most = std::max(most, list.size());
  std::vector<bool> marked = taken;
  int holes = 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (marked[i]) continue;
    bool open = false;
    flood(i, lists, marked, [&](std::size_t slot) { open |= lists[slot].size() < most; });
    holes += open ? 0 : 1;
  }
  return holes;
}

int outside_outline(std::span<const Eigen::Vector2d> taken, std::span<const Eigen::Vector2d> plan,
                    int symmetry) {
  // Lattice vectors come out in whole cells, but for rounding.
  const double cell_m = least_spacing_m(plan) / 20.0;
  if (!std::isfinite(cell_m)) return static_cast<int>(taken.size()) - (taken.empty() ? 0 : 1);
  int most = 0;
  for (int k = 0; k < symmetry; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / symmetry;
    const double c = std::cos(angle), s = std::sin(angle);
    std::map<std::pair<long, long>, int> covered;  // by the move of the plan
    for (const Eigen::Vector2d& slot : plan) {
      const Eigen::Vector2d turned(c * slot.x() - s * slot.y(), s * slot.x() + c * slot.y());
      for (const Eigen::Vector2d& place : taken) {
        const Eigen::Vector2d move = (place - turned) / cell_m;
        most = std::max(most, ++covered[{std::lround(move.x()), std::lround(move.y())}]);
      }
    }
  }
  return static_cast<int>(taken.size()) - most;
}

}  // namespace shoal::analysis
