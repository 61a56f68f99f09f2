#include <gtest/gtest.h>

#include "shoal/core/angles.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const char* const assignment_kind = "assignment_registration";

/// Those within the 550 m that an acoustic ping reaches, nameless.
Neighbours in_reach(const Neighbours& all) {
  Neighbours near;
  for (const Neighbour& n : all) {
    if (n.position.norm() <= 550.0) near.push_back(n);
  }
  return without_ids(near);
}

TEST(AssignmentRegistration, TakesTheFreeSlotOfTwo) {
  // Two slots 100 m apart, two vehicles 160 m apart. With the own weight w the plan's centre is
  // (160 - 0) / (1 + w) east of the vehicle, and the slot 100 / (1 + w) back from it.
  const Plan pair = plan_of({{0, 0}, {100, 0}});
  const Neighbours seen{{{160, 0}, 0.0, anonymous}};
  for (const double w : {0.1, 1.0, 4.0}) {
    const Target target =
        behaviour(assignment_kind, {{"ownship_weight", w}})->step({seen, 0}, pair);
    EXPECT_EQ(target.reason, Reason::placed);
    EXPECT_LT((target.position - Vector2d(60.0 / (1.0 + w), 0)).norm(), 1e-10) << w;
  }
}

TEST(AssignmentRegistration, FillsTheHoleOfALattice) {
  // The vehicle of the middle of a 3 x 3 lattice is 40 m off; the others, in place, hardly yield.
  const Plan lattice = square_lattice(3, 3, 300.0);
  const Neighbours seen = in_reach(heard(lattice, 4, {}, {24, -32}));
  ASSERT_EQ(seen.size(), 8u);
  const Target exact = behaviour(assignment_kind, {{"ownship_weight", 0.0},
                                                   {"matching.sampled.delta_theta_deg", 10.0}})
                           ->step({seen, 4}, lattice);
  EXPECT_LT((exact.position - Vector2d(-24, 32)).norm(), 1e-9);
  // By symmetry no rotation: the step is 8 / (8 + 0.1) of it.
  const Target thesis = behaviour(assignment_kind, {{"matching.sampled.delta_theta_deg", 10.0}})
                            ->step({seen, 4}, lattice);
  EXPECT_LT((thesis.position - 8.0 / 8.1 * Vector2d(-24, 32)).norm(), 1e-9);
}

TEST(AssignmentRegistration, GivesTheOwnSlotToWhoeverIsNearest) {
  // The own slot number means nothing: in reach of all, the vehicle takes the free corner.
  const Plan square = plan_of({{0, 0}, {300, 0}, {300, 300}, {0, 300}});
  const Neighbours seen = in_reach(heard(square, 2, {}, {20, 20}));
  const auto assignment = behaviour(assignment_kind, {{"ownship_weight", 0.0}});
  for (int own = 0; own < 4; ++own) {
    EXPECT_LT((assignment->step({seen, own}, square).position + Vector2d(20, 20)).norm(), 1e-9);
  }
}

TEST(AssignmentRegistration, AlignsTheCentroidsAsItsMatchingIsToldTo) {
  // With light own weight the weighted centroid is that of the neighbours. The cost is that of the
  // unrefined match: every distance, with the centroids laid on one another.
  const Plan line = plan_of({{0, 0}, {100, 0}, {250, 0}});
  const Neighbours seen{{{100, 0}, 0.0, anonymous}, {{280, 0}, 0.0, anonymous}};
  const auto cost = [&](const char* centroids) {
    const auto assignment = behaviour(
        assignment_kind, {{"matching.sampled.centroids", centroids}, {"ownship_weight", 0.5}});
    return assignment->step({seen, 0}, line).cost;
  };
  // Plain: centroids 126.67 and 116.67; residuals -10, -10, 20.
  EXPECT_NEAR(cost("plain"), 40.0, 1e-9);
  // Weighted, own slot as seed: 380 / 2.5 = 152 and 140; residuals -12, -12, 18. No other seed or
  // turn is cheaper: half a turn costs hundreds of metres, and the seeds 1 and 2 shift the plan by
  // (350 - 50) / 2.5 = 120 and (350 - 125) / 2.5 = 90.
  EXPECT_NEAR(cost("weighted"), 42.0, 1e-9);
}

// Four lattices of the library's sizes, at every slot and in many directions.
TEST(AssignmentRegistration, StaysWhereALatticeIsReachedWhateverItsPose) {
  const auto assignment = behaviour(assignment_kind, {{"matching.sampled.delta_theta_deg", 10.0}});
  for (const Plan& plan : {square_lattice(5, 4, 300.0), square_lattice(3, 3, 300.0)}) {
    for (int own = 0; own < plan.size(); ++own) {
      for (const double deg : {0.0, 4.0, 33.0, 95.0, 181.0, -77.0}) {
        const Transform2 pose = Transform2::from_angle(radians(deg), {1e4, -300});
        const Neighbours seen = in_reach(heard(plan, own, pose));
        const Target target = assignment->step({seen, own}, plan);
        EXPECT_EQ(target.reason, Reason::placed);
        EXPECT_LT(target.position.norm(), 1e-9) << "slot " << own << ", " << deg << " deg";
      }
    }
  }
}

TEST(AssignmentRegistration, ReturnsToItsSlotWhateverThePoseOfAnyFormation) {
  const auto assignment = behaviour(assignment_kind, {{"contact_rangeout_m", 1e4},
                                                      {"ownship_weight", 0.0},
                                                      {"matching.sampled.delta_theta_deg", 1.0}});
  EXPECT_TRUE(rc::check("neighbours as planned: exactly the own slot", [&] {
    const Plan plan = drawn_plan(4, 9);
    for (int i = 0; i < plan.size(); ++i) {  // a step of 1 degree tells slots 40 m apart
      for (int j = 0; j < i; ++j) RC_PRE((plan.slot(i) - plan.slot(j)).norm() > 40.0);
    }
    const int own = drawn_int(0, plan.size() - 1);
    const Vector2d displaced = drawn_point(5);
    const Neighbours seen = without_ids(heard(plan, own, drawn_motion(), displaced));
    RC_ASSERT((assignment->step({seen, own}, plan).position + displaced).norm() < 1e-8);
  }));
}

TEST(AssignmentRegistration, TurnsByWholeStepsAndIgnoresPlanFrameNumbersAndOrder) {
  const auto assignment = behaviour(
      assignment_kind, {{"contact_rangeout_m", 1e4}, {"matching.sampled.delta_theta_deg", 10.0}});
  EXPECT_TRUE(rc::check("rotation by steps, translation of the plan, labels, order", [&] {
    const Plan plan = drawn_plan(3, 10);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = without_ids(drawn_neighbours(plan, own));
    const Target target = assignment->step({seen, own}, plan);
    const auto same = [&](const Target& other) {
      return std::abs(other.cost - target.cost) < 1e-6 &&
             (other.position - target.position).norm() < 1e-6;
    };
    const Transform2 turn = rotation(radians(10.0 * drawn_int(0, 35)));
    Target by_turned = assignment->step({turned(seen, turn), own}, plan);
    by_turned.position = turn.inverse().rotate(by_turned.position);
    RC_ASSERT(same(by_turned));

    const Transform2 shift{.translation = drawn_point(5000)};
    RC_ASSERT(same(assignment->step({seen, own}, moved(plan, shift))));
    RC_ASSERT(same(assignment->step({shuffled(seen), own}, plan)));
    RC_ASSERT(same(assignment->step({seen, 0}, renumbered(plan, drawn_order(plan.size())))));
  }));
}

// Degenerate swarms -----------------------------------------------------------------------------

TEST(AssignmentRegistration, HoldsWhenItHearsNoVehicle) {
  const Plan plan = square_lattice(3, 3, 300.0);
  EXPECT_EQ(behaviour(assignment_kind)->step({{}, 0}, plan).reason, Reason::no_neighbour);
  const Neighbours far{{{651, 0}, 0.0, anonymous}};
  EXPECT_EQ(behaviour(assignment_kind)->step({far, 0}, plan).reason, Reason::no_neighbour);
}

TEST(AssignmentRegistration, HoldsWhenThePlanIsForItAlone) {
  const Neighbours seen{{{100, 0}, 0.0, anonymous}};
  EXPECT_EQ(behaviour(assignment_kind)->step({seen, 0}, plan_of({{0, 0}})).reason,
            Reason::no_neighbour);
}

TEST(AssignmentRegistration, HoldsWhereNothingFixesTheDirection) {
  const Plan plan = square_lattice(2, 2, 300.0);
  const Neighbours here(3, {{0, 0}, 0.0, anonymous});
  EXPECT_EQ(behaviour(assignment_kind)->step({here, 0}, plan).reason, Reason::degenerate);
}

TEST(AssignmentRegistration, CountsTheNearestWhenMoreAreHeardThanThePlanHasSlots) {
  const Plan square = square_lattice(2, 2, 300.0);
  Neighbours seen = in_reach(heard(square, 0, {}, {-30, -30}));
  ASSERT_EQ(seen.size(), 3u);
  const Vector2d target = behaviour(assignment_kind)->step({seen, 0}, square).position;
  seen.insert(seen.begin(), {{-550, 40}, 0.0, anonymous});  // ghosts of vehicles that have gone
  seen.push_back({{30, -600}, 0.0, anonymous});
  EXPECT_LT((behaviour(assignment_kind)->step({seen, 0}, square).position - target).norm(), 1e-9);
}

TEST(AssignmentRegistration, PlacesAVehicleInALineOfOthers) {
  const Plan line = plan_of({{0, 0}, {100, 0}, {250, 0}, {450, 0}});
  const Neighbours seen = without_ids(heard(line, 1, rotation(radians(30.0)), {3, 7}));
  const Target target = behaviour(assignment_kind, {{"ownship_weight", 0.0},
                                                    {"matching.sampled.delta_theta_deg", 10.0}})
                            ->step({seen, 1}, line);
  EXPECT_LT((target.position + Vector2d(3, 7)).norm(), 1e-9);
}

TEST(AssignmentRegistration, NeverAnswersAMirroredFormationWithAReflection) {
  const Plan hook = plan_of({{0, 0}, {300, 0}, {300, 100}, {0, 200}, {150, -100}});
  Neighbours mirrored = without_ids(heard(hook, 0));
  for (Neighbour& n : mirrored) n.position.y() *= -1.0;
  const Target target = behaviour(assignment_kind, {{"matching.sampled.delta_theta_deg", 10.0}})
                            ->step({mirrored, 0}, hook);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_GT(target.cost, 50.0);  // a reflection would match without residual
}

}  // namespace
}  // namespace shoal::formations
