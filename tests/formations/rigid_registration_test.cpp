#include <gtest/gtest.h>

#include "shoal/core/angles.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const char* const kind = "rigid_registration";

// Own slot 0 in the middle of four neighbours.
const Plan cross = plan_of({{0, 0}, {100, 0}, {0, 100}, {-100, 0}, {0, -100}});

TEST(RigidRegistration, SendsTheOwnVehicleToItsSlotAmongNeighboursThatMoved) {
  // Neighbours 20 m further east than planned, the vehicle in between: no rotation, and of five
  // points of weight 1 four moved.
  const Neighbours seen = heard(cross, 0, {}, {-20, 0});
  const Target target = behaviour(kind)->step({seen, 0}, cross);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_NEAR(target.position.x(), 16.0, 1e-12);
  EXPECT_NEAR(target.position.y(), 0.0, 1e-12);
  EXPECT_NEAR(target.cost, 4.0 * 4 * 4 + 16.0 * 16, 1e-9);
}

TEST(RigidRegistration, StepsByTheShareOfTheNeighboursInTheWeight) {
  const Vector2d answer(30, -50);
  const Neighbours seen = heard(cross, 0, rotation(radians(70.0)), -answer);
  for (const double weight : {0.0, 0.1, 1.0, 4.0, 1000.0}) {
    const Target target = behaviour(kind, {{"ownship_weight", weight}})->step({seen, 0}, cross);
    EXPECT_LT((target.position - 4.0 / (4.0 + weight) * answer).norm(), 1e-10) << weight;
  }
}

TEST(RigidRegistration, IgnoresNeighboursOutOfRangeAndWithoutId) {
  Neighbours seen = heard(cross, 0, {}, {-20, 0});
  const Target alone = behaviour(kind)->step({seen, 0}, cross);
  seen.push_back({{10, 10}, 0.0, anonymous});
  seen.push_back({{500, 500}, 0.0, 1});
  EXPECT_EQ(behaviour(kind)->step({seen, 0}, cross).position, alone.position);
}

TEST(RigidRegistration, StaysWhereTheFormationIsAsPlannedWhateverItsPose) {
  const auto rigid = behaviour(kind, {{"contact_rangeout_m", 1e4}});
  EXPECT_TRUE(rc::check("placed as planned: zero displacement", [&] {
    const Plan plan = drawn_plan(2, 20);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = heard(plan, own, drawn_motion());
    const Target target = rigid->step({seen, own}, plan);
    RC_ASSERT(target.reason == Reason::placed);
    RC_ASSERT(target.position.norm() < 1e-9);
    RC_ASSERT(target.cost < 1e-6);
  }));
}

TEST(RigidRegistration, FindsTheExactSlotWhenOnlyTheNeighboursCount) {
  const auto rigid = behaviour(kind, {{"contact_rangeout_m", 1e4}, {"ownship_weight", 0.0}});
  EXPECT_TRUE(rc::check("neighbours as planned: exactly the own slot", [&] {
    const Plan plan = drawn_plan(3, 20);
    const int own = drawn_int(0, plan.size() - 1);
    const Vector2d displaced = drawn_point(300);
    const Neighbours seen = heard(plan, own, drawn_motion(), displaced);
    // Neighbours 5 m apart give a direction whose rounding grows over the distance to the slot.
    RC_ASSERT((rigid->step({seen, own}, plan).position + displaced).norm() < 1e-8);
  }));
}

TEST(RigidRegistration, TurnsWithTheNeighboursAndIgnoresPoseNumbersAndOrder) {
  const auto rigid = behaviour(kind, {{"contact_rangeout_m", 1e4}});
  EXPECT_TRUE(rc::check("rotation, plan frame, labels, order", [&] {
    const Plan plan = drawn_plan(3, 16);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = drawn_neighbours(plan, own);
    const Vector2d target = rigid->step({seen, own}, plan).position;

    const Transform2 turn = rotation(drawn_angle());
    const Vector2d by_turned = rigid->step({turned(seen, turn), own}, plan).position;
    RC_ASSERT((by_turned - turn.rotate(target)).norm() < 1e-7);

    const Vector2d by_moved = rigid->step({seen, own}, moved(plan, drawn_motion())).position;
    RC_ASSERT((by_moved - target).norm() < 1e-7);

    const std::vector<int> order = drawn_order(plan.size());
    Neighbours relabelled = shuffled(seen);
    for (Neighbour& n : relabelled) n.slot = order[static_cast<std::size_t>(n.slot)];
    const int own_anew = order[static_cast<std::size_t>(own)];
    const Vector2d by_labels =
        rigid->step({relabelled, own_anew}, renumbered(plan, order)).position;
    RC_ASSERT((by_labels - target).norm() < 1e-7);
  }));
}

TEST(RigidRegistration, HoldsWhenItHearsNobodyItKnows) {
  const auto rigid = behaviour(kind);
  EXPECT_EQ(rigid->step({{}, 0}, cross).reason, Reason::no_neighbour);
  const Neighbours strangers = without_ids(heard(cross, 0));
  const Target target = rigid->step({strangers, 0}, cross);
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(RigidRegistration, KeepsTheDirectionToASingleNeighbour) {
  // Planned 100 m apart, found 160 m apart: both ends of the plan take half of the difference.
  const Neighbours seen{{{0, 160}, 0.0, 1}};
  const Target target = behaviour(kind)->step({seen, 0}, cross);
  EXPECT_LT((target.position - Vector2d(0, 30)).norm(), 1e-12);
}

TEST(RigidRegistration, HoldsWhereNothingFixesTheDirection) {
  const Neighbours here{{{0, 0}, 0.0, 1}, {{0, 0}, 0.0, 2}};
  EXPECT_EQ(behaviour(kind)->step({here, 0}, cross).reason, Reason::degenerate);
  const Neighbours one{{{50, 0}, 0.0, 1}};
  EXPECT_EQ(behaviour(kind, {{"ownship_weight", 0.0}})->step({one, 0}, cross).reason,
            Reason::degenerate);
}

TEST(RigidRegistration, PlacesAVehicleInALineOfOthers) {
  const Plan line = plan_of({{0, 0}, {100, 0}, {200, 0}, {300, 0}});
  const Neighbours seen = heard(line, 1, rotation(2.0), {7, 7});
  const Target target = behaviour(kind, {{"ownship_weight", 0.0}})->step({seen, 1}, line);
  EXPECT_LT((target.position + Vector2d(7, 7)).norm(), 1e-10);
}

TEST(RigidRegistration, NeverAnswersAMirroredFormationWithAReflection) {
  const Plan hook = plan_of({{0, 0}, {200, 0}, {200, 100}, {0, 300}});
  Neighbours mirrored = heard(hook, 0);
  for (Neighbour& n : mirrored) n.position.y() *= -1.0;
  const Target target = behaviour(kind)->step({mirrored, 0}, hook);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_GT(target.cost, 1e4);             // a reflection would fit without residual
  EXPECT_GT(target.position.norm(), 1.0);  // and leave the vehicle where it is
}

}  // namespace
}  // namespace shoal::formations
