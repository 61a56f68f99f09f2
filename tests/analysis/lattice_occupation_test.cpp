#include "shoal/analysis/experiments/measures/lattice_occupation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace shoal::analysis {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points square(int rows, int columns) {
  Points points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      points.emplace_back(300.0 * column, 300.0 * row);
  }
  return points;
}

Points hexagonal(int rows, int columns) {
  Points points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      points.emplace_back(300.0 * column + 150.0 * (row % 2), 150.0 * std::sqrt(3.0) * row);
    }
  }
  return points;
}

std::vector<bool> all_but(std::size_t size, const std::vector<std::size_t>& empty) {
  std::vector<bool> taken(size, true);
  for (const std::size_t slot : empty) taken[slot] = false;
  return taken;
}

TEST(LatticeOccupation, KnowsTheLeastSpacing) {
  EXPECT_NEAR(least_spacing_m(hexagonal(3, 3)), 300.0, 1e-9);
  EXPECT_EQ(least_spacing_m(Points{{1, 2}}), std::numeric_limits<double>::infinity());
}

TEST(LatticeOccupation, PartsGroupsByTheGapBetweenThem) {
  EXPECT_EQ(groups_within(hexagonal(5, 5), 450.0), 1);
  Points parted = square(4, 4);
  for (std::size_t i = 8; i < 16; ++i) parted[i].y() += 149.0;
  EXPECT_EQ(groups_within(parted, 450.0), 1);
  for (std::size_t i = 8; i < 16; ++i) parted[i].y() += 2.0;
  EXPECT_EQ(groups_within(parted, 450.0), 2);
  EXPECT_EQ(groups_within(Points{}, 450.0), 0);
}

TEST(LatticeOccupation, OfAWholeFormationInAPaddedPlanHasNoHole) {
  const Points slots = square(6, 6);
  std::vector<bool> taken(slots.size(), false);
  for (std::size_t row = 1; row < 5; ++row) {
    for (std::size_t column = 1; column < 5; ++column) taken[6 * row + column] = true;
  }
  EXPECT_EQ(holes(slots, taken), 0);
  taken[6 * 2 + 2] = false;  // inside
  EXPECT_EQ(holes(slots, taken), 1);
  taken[6 * 2 + 3] = false;  // beside it: the same hole
  EXPECT_EQ(holes(slots, taken), 1);
  taken[6 * 1 + 3] = false;  // in the outline: it opens the hole
  EXPECT_EQ(holes(slots, taken), 0);
}

TEST(LatticeOccupation, OfAHexagonalLatticeHasHolesWhereSixVehiclesCloseOneIn) {
  const Points slots = hexagonal(7, 7);
  EXPECT_EQ(holes(slots, all_but(slots.size(), {7 * 2 + 2})), 1);
  EXPECT_EQ(holes(slots, all_but(slots.size(), {7 * 2 + 2, 7 * 4 + 4})), 2);
  EXPECT_EQ(holes(slots, all_but(slots.size(), {3})), 0);  // at the rim
}

TEST(LatticeOccupation, FindsTheOutlineWhereverItLies) {
  const Points plan = square(4, 5);
  EXPECT_EQ(outside_outline(plan, plan, 4), 0);
  Points moved = plan;
  for (Eigen::Vector2d& slot : moved) slot += Eigen::Vector2d(-600.0, 300.0);
  EXPECT_EQ(outside_outline(moved, plan, 4), 0);
  EXPECT_EQ(outside_outline(square(5, 4), plan, 4), 0);  // turned by a quarter
  EXPECT_EQ(outside_outline(square(5, 4), plan, 1), 4);  // four rows of four lie in it
}

TEST(LatticeOccupation, CountsVehiclesOutsideTheOutline) {
  Points taken = square(4, 5);
  taken.front() = {-300.0, 300.0};
  EXPECT_EQ(outside_outline(taken, square(4, 5), 4), 1);
  taken.back() = {1500.0, 600.0};
  EXPECT_EQ(outside_outline(taken, square(4, 5), 4), 2);
  Points hexagon = hexagonal(5, 4);
  hexagon.back() = hexagon.front() - Eigen::Vector2d(300.0, 0.0);
  EXPECT_EQ(outside_outline(hexagon, hexagonal(5, 4), 6), 1);
}

TEST(LatticeOccupation, OfASwarmThatLostVehiclesLiesInTheOutline) {
  Points taken = hexagonal(5, 4);
  taken.erase(taken.begin() + 7);
  taken.erase(taken.begin() + 2);
  EXPECT_EQ(outside_outline(taken, hexagonal(5, 4), 6), 0);
}

}  // namespace
}  // namespace shoal::analysis
