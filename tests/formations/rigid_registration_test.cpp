#include <gtest/gtest.h>

#include "shoal/core/angles.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

TEST(RigidRegistration, SendsTheOwnVehicleToItsSlotAmongNeighboursThatMoved) {
  // Neighbours 20 m further east than planned, the vehicle in between: no rotation, and of five
  // points of weight 1 four moved.
  const Neighbours seen = heard(cross_plan, 0, {}, {-20, 0});
  const Target target = behaviour(rigid_kind)->step({seen, 0}, cross_plan);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_NEAR(target.position.x(), 16.0, 1e-12);
  EXPECT_NEAR(target.position.y(), 0.0, 1e-12);
  EXPECT_NEAR(target.cost, 4.0 * 4 * 4 + 16.0 * 16, 1e-9);
}

TEST(RigidRegistration, StepsByTheShareOfTheNeighboursInTheWeight) {
  const Vector2d answer(30, -50);
  const Neighbours seen = heard(cross_plan, 0, rotation(radians(70.0)), -answer);
  for (const double weight : {0.0, 0.1, 1.0, 4.0, 1000.0}) {
    const Target target =
        behaviour(rigid_kind, {{"ownship_weight", weight}})->step({seen, 0}, cross_plan);
    EXPECT_LT((target.position - 4.0 / (4.0 + weight) * answer).norm(), 1e-10) << weight;
  }
}

TEST(RigidRegistration, IgnoresNeighboursOutOfRangeAndWithoutId) {
  Neighbours seen = heard(cross_plan, 0, {}, {-20, 0});
  const Target alone = behaviour(rigid_kind)->step({seen, 0}, cross_plan);
  seen.push_back({{10, 10}, 0.0, anonymous});
  seen.push_back({{500, 500}, 0.0, 1});
  EXPECT_EQ(behaviour(rigid_kind)->step({seen, 0}, cross_plan).position, alone.position);
}

TEST(RigidRegistration, WeighsNeighboursByNearnessOrFreshness) {
  // All on one line, so that nothing turns: the plan moves by the weighted mean of 0, 10 and -30 m.
  const Plan line = plan_of({{0, 0}, {100, 0}, {-200, 0}});
  const Neighbours seen{{{110, 0}, 30.0, 1}, {{-230, 0}, 150.0, 2}};
  const auto step = [&](const char* weighting) {
    const Target target = behaviour(rigid_kind, {{"weighting", weighting}})->step({seen, 0}, line);
    EXPECT_NEAR(target.position.y(), 0.0, 1e-12);
    return target.position.x();
  };
  EXPECT_NEAR(step("none"), -20.0 / 3.0, 1e-12);
  const double near = 1.0 - 110.0 / 650.0, far = 1.0 - 230.0 / 650.0;
  EXPECT_NEAR(step("distance"), (10.0 * near - 30.0 * far) / (1.0 + near + far), 1e-12);
  EXPECT_NEAR(step("ping_age"), 10.0 * 0.75 / 1.75, 1e-12);  // 1 - 30 s / 120 s, and none
}

TEST(RigidRegistration, HoldsWhenAllPingsAreOlderThanTheirWeightLasts) {
  const Neighbours seen{{{110, 0}, 130.0, 1}, {{-50, 100}, 125.0, 2}};
  EXPECT_EQ(behaviour(rigid_kind, {{"weighting", "ping_age"}})->step({seen, 0}, cross_plan).reason,
            Reason::degenerate);
}

TEST(RigidRegistration, StaysWhereTheFormationIsAsPlannedWhateverItsPose) {
  const auto rigid = behaviour(rigid_kind, {{"contact_rangeout_m", 1e4}});
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
  const auto rigid = behaviour(rigid_kind, {{"contact_rangeout_m", 1e4}, {"ownship_weight", 0.0}});
  EXPECT_TRUE(rc::check("neighbours as planned: exactly the own slot", [&] {
    const Plan plan = drawn_plan(3, 20);
    const int own = drawn_int(0, plan.size() - 1);
    const Vector2d displaced = drawn_point(300);
    const Neighbours seen = heard(plan, own, drawn_motion(), displaced);
    // Neighbours 5 m apart give a direction whose rounding grows over the distance to the slot.
    RC_ASSERT((rigid->step({seen, own}, plan).position + displaced).norm() < 1e-8);
  }));
}

TEST(RigidRegistration, HoldsWhenItHearsNoVehicleOfThePlan) {
  const auto rigid = behaviour(rigid_kind);
  EXPECT_EQ(rigid->step({{}, 0}, cross_plan).reason, Reason::no_neighbour);
  const Neighbours strangers = without_ids(heard(cross_plan, 0));
  const Target target = rigid->step({strangers, 0}, cross_plan);
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(RigidRegistration, KeepsTheDirectionToASingleNeighbour) {
  // Planned 100 m apart, found 160 m apart: both ends of the plan take half of the difference.
  const Neighbours seen{{{0, 160}, 0.0, 1}};
  const Target target = behaviour(rigid_kind)->step({seen, 0}, cross_plan);
  EXPECT_LT((target.position - Vector2d(0, 30)).norm(), 1e-12);
}

TEST(RigidRegistration, HoldsWhereNothingFixesTheDirection) {
  const Neighbours here{{{0, 0}, 0.0, 1}, {{0, 0}, 0.0, 2}};
  EXPECT_EQ(behaviour(rigid_kind)->step({here, 0}, cross_plan).reason, Reason::degenerate);
  const Neighbours one{{{50, 0}, 0.0, 1}};
  EXPECT_EQ(behaviour(rigid_kind, {{"ownship_weight", 0.0}})->step({one, 0}, cross_plan).reason,
            Reason::degenerate);
}

TEST(RigidRegistration, PlacesAVehicleInALineOfOthers) {
  const Plan line = plan_of({{0, 0}, {100, 0}, {200, 0}, {300, 0}});
  const Neighbours seen = heard(line, 1, rotation(2.0), {7, 7});
  const Target target = behaviour(rigid_kind, {{"ownship_weight", 0.0}})->step({seen, 1}, line);
  EXPECT_LT((target.position + Vector2d(7, 7)).norm(), 1e-10);
}

TEST(RigidRegistration, NeverAnswersAMirroredFormationWithAReflection) {
  const Plan hook = plan_of({{0, 0}, {200, 0}, {200, 100}, {0, 300}});
  Neighbours mirrored = heard(hook, 0);
  for (Neighbour& n : mirrored) n.position.y() *= -1.0;
  const Target target = behaviour(rigid_kind)->step({mirrored, 0}, hook);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_GT(target.cost, 1e4);             // a reflection would fit without residual
  EXPECT_GT(target.position.norm(), 1.0);  // and leave the vehicle where it is
}

}  // namespace
}  // namespace shoal::formations
