#include "shoal/core/grid_index.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

namespace shoal {
namespace {

struct Points {
  std::vector<double> x, y;
};

/// Points on a coarse raster, so that many coincide or lie on the border of a cell.
Points some_points(double scale_m) {
  const auto raster = rc::gen::inRange(-40, 40);
  const auto cells =
      *rc::gen::container<std::vector<std::pair<int, int>>>(rc::gen::pair(raster, raster));
  Points points;
  for (const auto& [column, row] : cells) {
    points.x.push_back(scale_m * column);
    points.y.push_back(scale_m * row);
  }
  return points;
}

std::vector<std::size_t> visited(const GridIndex& index, double x, double y) {
  std::vector<std::size_t> found;
  index.near(x, y, [&](std::size_t i) { found.push_back(i); });
  return found;
}

/// Every point within the cell size is visited, none twice, none beyond two cells' diagonal.
void check_around(const GridIndex& index, const Points& points, double x, double y, double cell_m) {
  const std::vector<std::size_t> found = visited(index, x, y);
  const std::set<std::size_t> unique(found.begin(), found.end());
  RC_ASSERT(unique.size() == found.size());
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double distance = std::hypot(points.x[i] - x, points.y[i] - y);
    if (distance < cell_m) RC_ASSERT(unique.contains(i));
    if (unique.contains(i)) RC_ASSERT(distance <= 2.0 * std::sqrt(2.0) * cell_m);
  }
}

TEST(GridIndex, VisitsEveryPointWithinTheCellSizeOnce) {
  EXPECT_TRUE(rc::check("around points", [] {
    const double cell_m = *rc::gen::element(1.0, 3.0, 7.5, 500.0);
    const Points points = some_points(*rc::gen::element(0.25, 1.0, 10.0));
    GridIndex index;
    index.build(points.x, points.y, cell_m);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
      check_around(index, points, points.x[i], points.y[i], cell_m);
    }
    const double x = 0.25 * *rc::gen::inRange(-200, 200);
    const double y = 0.25 * *rc::gen::inRange(-200, 200);
    check_around(index, points, x, y, cell_m);
  }));
}

TEST(GridIndex, ForgetsThePointsOfTheLastBuild) {
  EXPECT_TRUE(rc::check("rebuild", [] {
    const Points before = some_points(1.0);
    const Points after = some_points(1.0);
    GridIndex used;
    used.build(before.x, before.y, 5.0);
    used.build(after.x, after.y, 2.0);
    GridIndex fresh;
    fresh.build(after.x, after.y, 2.0);
    RC_ASSERT(visited(used, 0.5, 0.5) == visited(fresh, 0.5, 0.5));
  }));
}

TEST(GridIndex, FindsPointsFarAwayFromTheOrigin) {
  for (const double far : {1e4, -1e9, 1e15, -1e30, 1e300}) {
    const std::vector<double> x{far, 0.0, far, -far};
    const std::vector<double> y{-far, 0.0, -far, far};
    GridIndex index;
    index.build(x, y, 10.0);
    const auto found = visited(index, far, -far);
    EXPECT_EQ(found, (std::vector<std::size_t>{0, 2})) << far;
    EXPECT_EQ(visited(index, 0.0, 0.0), std::vector<std::size_t>{1}) << far;
  }
}

TEST(GridIndex, SeparatesPointsOnBothSidesOfTheOrigin) {
  const std::vector<double> x{-0.5, 0.5, -25.0, 25.0};
  const std::vector<double> y{-0.5, 0.5, 0.0, 0.0};
  GridIndex index;
  index.build(x, y, 10.0);
  auto found = visited(index, -1.0, -1.0);
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::vector<std::size_t>{0, 1}));
}

TEST(GridIndex, HasNothingToVisitWhenEmpty) {
  GridIndex index;
  EXPECT_TRUE(visited(index, 1.0, 2.0).empty());
  index.build({}, {}, 10.0);
  EXPECT_TRUE(visited(index, 1.0, 2.0).empty());
}

}  // namespace
}  // namespace shoal
