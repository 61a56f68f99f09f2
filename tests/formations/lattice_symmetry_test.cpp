#include "shoal/formations/lattice_symmetry.hpp"

#include <gtest/gtest.h>

#include "shoal/core/angles.hpp"
#include "shoal/core/transform.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;
using Slots = std::vector<Vector2d>;
using tests::plan_of;

Slots lattice(int side, const Vector2d& first, const Vector2d& second) {
  Slots slots;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) slots.push_back(300.0 * (i * first + j * second));
  }
  return slots;
}

const Vector2d eastward(1.0, 0.0), northward(0.0, 1.0), at_60_deg(0.5, std::sqrt(0.75));

TEST(LatticeSymmetry, IsSixOfAHexagonalLattice) {
  EXPECT_EQ(lattice_symmetry(plan_of(lattice(4, eastward, at_60_deg))), 6);
}

TEST(LatticeSymmetry, IsFourOfASquareLattice) {
  EXPECT_EQ(lattice_symmetry(plan_of(lattice(4, eastward, northward))), 4);
  EXPECT_EQ(lattice_symmetry(plan_of(lattice(2, eastward, northward))), 4);
}

TEST(LatticeSymmetry, IsTwoWhereBondsLieAlongOneLine) {
  EXPECT_EQ(lattice_symmetry(plan_of({{0, 0}, {300, 0}, {600, 0}})), 2);
  EXPECT_EQ(lattice_symmetry(plan_of(lattice(3, eastward, 2.0 * northward))), 2);
}

TEST(LatticeSymmetry, IsOneOfASingleSlot) {
  EXPECT_EQ(lattice_symmetry(plan_of({{5, 5}})), 1);
}

TEST(LatticeSymmetry, DoesNotDependOnThePoseOfThePlanOrTheOrderOfItsSlots) {
  for (int turn = 0; turn < 36; ++turn) {
    const Transform2 T = Transform2::from_angle(radians(10.0 * turn + 3.0), {1e4, -2e4});
    for (const auto& [second, order] : {std::pair{at_60_deg, 6}, std::pair{northward, 4}}) {
      Slots slots = lattice(5, eastward, second);
      std::rotate(slots.begin(), slots.begin() + turn % 25, slots.end());
      for (Vector2d& slot : slots) slot = T * slot;
      EXPECT_EQ(lattice_symmetry(plan_of(slots)), order) << turn;
    }
  }
}

}  // namespace
}  // namespace shoal::formations
