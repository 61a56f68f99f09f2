#include "shoal/solvers/matching/slot_lattice.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "shoal/solvers/matching/slot_field.hpp"
#include "tests/solvers/matching_support.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;
using tests::centred;
using tests::lattice;
using tests::moved;

Points ring(int count) {
  Points slots;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    slots.emplace_back(500.0 * std::cos(angle), 500.0 * std::sin(angle));
  }
  return slots;
}

TEST(RotationalSymmetry, IsThatOfTheWholePlan) {
  EXPECT_EQ(rotational_symmetry(centred(lattice(5, 5, 300.0))), 4);
  EXPECT_EQ(rotational_symmetry(centred(lattice(5, 4, 300.0))), 2);
  EXPECT_EQ(rotational_symmetry(ring(7)), 7);
  Points hub = ring(6);
  hub.emplace_back(0, 0);
  EXPECT_EQ(rotational_symmetry(hub), 6);
  EXPECT_EQ(rotational_symmetry(centred(Points{{0, 0}, {100, 0}, {0, 70}})), 1);
  EXPECT_EQ(rotational_symmetry(Points{{0, 0}}), 1);
  const Transform2 turn = Transform2::from_angle(0.7, {0, 0});
  EXPECT_EQ(rotational_symmetry(moved(centred(lattice(6, 6, 300.0)), turn)), 4);
}

TEST(SlotLattice, IsFoundWhereverItLies) {
  Points hexagonal;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 5; ++j)
      hexagonal.emplace_back(300.0 * (i + 0.5 * j), 150.0 * std::sqrt(3.0) * j);
  }
  const Transform2 T = Transform2::from_angle(1.1, {4000, -300});
  for (const auto& [slots, symmetry] :
       {std::pair(lattice(5, 4, 300.0), 4), std::pair(hexagonal, 6)}) {
    const Points there = moved(slots, T);
    const auto found = SlotLattice::of(there);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->symmetry, symmetry);
    EXPECT_NEAR(found->a.norm(), 300.0, 1e-9);
    EXPECT_NEAR(found->b.norm(), 300.0, 1e-9);
    for (const Vector2d& slot : there) {
      const Eigen::Vector2i c = found->coordinates(slot - there[0]);
      EXPECT_NEAR((there[0] + c.x() * found->a + c.y() * found->b - slot).norm(), 0.0, 1e-9);
    }
  }
}

TEST(SlotLattice, IsNotSeenWhereThereIsNone) {
  EXPECT_FALSE(SlotLattice::of(ring(5)));
  EXPECT_FALSE(SlotLattice::of(Points{{0, 0}}));
  EXPECT_FALSE(SlotLattice::of(Points{{0, 0}, {100, 0}, {200, 0}})) << "a line";
  Points bent = lattice(4, 4, 300.0);
  bent[5].x() += 0.01;
  EXPECT_FALSE(SlotLattice::of(bent));
}

TEST(SlotField, IsNeverFartherThanTheNearestSlot) {
  const Points slots = lattice(5, 4, 300.0);
  const SlotField field(slots);
  EXPECT_TRUE(rc::check("a lower bound", [&] {
    const Vector2d at(*rc::gen::inRange(-3000, 4000) + 0.3, *rc::gen::inRange(-3000, 3000) + 0.7);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2d& slot : slots) nearest = std::min(nearest, (slot - at).norm());
    const double found = field.distance_at_least(at.x(), at.y());
    RC_ASSERT(found <= nearest);
    const bool inside = at.x() > -100 && at.x() < 1300 && at.y() > -1000 && at.y() < 100;
    if (inside) RC_ASSERT(found > nearest - 20.0);
  }));
}

}  // namespace
}  // namespace shoal::solvers
