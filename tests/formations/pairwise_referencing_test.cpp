#include <gtest/gtest.h>

#include "shoal/core/angles.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

// A triangle with the own slot 100 m north of the middle of the pair, and a further slot.
const Plan triangle = plan_of({{0, 100}, {-50, 0}, {50, 0}, {200, 100}});

TEST(PairwiseReferencing, ProjectsFromTheActualMidpointAlongTheActualPair) {
  // The pair stands north-south, 1 below 2, so "north of the pair" is west of it.
  const Neighbours seen{{{80, -30}, 0.0, 1}, {{80, 30}, 0.0, 2}};
  const Target target = behaviour(pairwise_kind)->step({seen, 0}, triangle);
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_LT((target.position - Vector2d(-20, 0)).norm(), 1e-12);
}

TEST(PairwiseReferencing, KeepsThePlannedDistanceOfAPairThatIsStretched) {
  const Neighbours seen{{{-300, -130}, 0.0, 1}, {{300, -130}, 0.0, 2}};
  const Target target = behaviour(pairwise_kind)->step({seen, 0}, triangle);
  EXPECT_LT((target.position - Vector2d(0, -30)).norm(), 1e-12);
}

TEST(PairwiseReferencing, WeighsPairsByTheNearnessOfTheirMidpoints) {
  // Targets of the pairs, by hand: neighbours without rotation, each displaced along the line.
  const Plan line = plan_of({{0, 0}, {100, 0}, {200, 0}, {400, 0}});
  const Neighbours seen{{{110, 0}, 0.0, 1}, {{230, 0}, 0.0, 2}, {{370, 0}, 0.0, 3}};
  // Midpoints 170, 240, 300; planned offsets -150, -250, -300: targets 20, -10, 0.
  const double w12 = 1.0 - 170.0 / 650.0, w13 = 1.0 - 240.0 / 650.0, w23 = 1.0 - 300.0 / 650.0;
  const Target target = behaviour(pairwise_kind)->step({seen, 0}, line);
  EXPECT_NEAR(target.position.x(), (20.0 * w12 - 10.0 * w13) / (w12 + w13 + w23), 1e-12);
  EXPECT_NEAR(target.position.y(), 0.0, 1e-12);

  const Target plain = behaviour(pairwise_kind, {{"weighting", "none"}})->step({seen, 0}, line);
  EXPECT_NEAR(plain.position.x(), 10.0 / 3.0, 1e-12);
}

TEST(PairwiseReferencing, IgnoresPairsWhoseMidpointIsOutOfRange) {
  const Neighbours seen{{{-50, -300}, 0.0, 1}, {{50, -300}, 0.0, 2}, {{2000, 0}, 0.0, 3}};
  const Target target = behaviour(pairwise_kind)->step({seen, 0}, triangle);
  EXPECT_LT((target.position - Vector2d(0, -200)).norm(), 1e-12);
}

// The author's program: weights by the age of the pings, divided by the count of the pairs
// (BHV_PairwiseNeighbourReferencing with weight_averaging=false).
TEST(PairwiseReferencing, ShrinksTheTargetAsPingsAgeInTheAuthorsVariant) {
  Neighbours seen = heard(triangle, 0, rotation(1.0), {40, -30});
  for (Neighbour& n : seen) n.age_s = 30.0;
  const Vector2d full(-40, 30);
  const auto step = [&](const char* normalisation) {
    return behaviour(pairwise_kind, {{"weighting", "ping_age"}, {"normalisation", normalisation}})
        ->step({seen, 0}, triangle)
        .position;
  };
  EXPECT_LT((step("count") - 0.75 * full).norm(), 1e-10);  // 1 - 30 s / 120 s
  EXPECT_LT((step("weights") - full).norm(), 1e-10);
}

TEST(PairwiseReferencing, AveragesTheAgesOfAPair) {
  const Neighbours seen{{{-50, -130}, 0.0, 1}, {{50, -130}, 60.0, 2}};
  const Target target =
      behaviour(pairwise_kind, {{"weighting", "ping_age"}, {"normalisation", "count"}})
          ->step({seen, 0}, triangle);
  EXPECT_LT((target.position - 0.75 * Vector2d(0, -30)).norm(), 1e-12);
}

TEST(PairwiseReferencing, HoldsWhenAllPingsAreOlderThanTheirWeightLasts) {
  const Neighbours seen{{{-50, -130}, 130.0, 1}, {{50, -130}, 125.0, 2}};
  EXPECT_EQ(behaviour(pairwise_kind, {{"weighting", "ping_age"}})->step({seen, 0}, triangle).reason,
            Reason::degenerate);
}

TEST(PairwiseReferencing, FindsTheExactSlotWhereverTheVehicleAndTheFormationAre) {
  for (const char* weighting : {"distance", "ping_age", "none"}) {
    const auto pairwise =
        behaviour(pairwise_kind, {{"contact_rangeout_m", 1e4}, {"weighting", weighting}});
    EXPECT_TRUE(rc::check("neighbours as planned: exactly the own slot", [&] {
      const Plan plan = drawn_plan(3, 16);
      const int own = drawn_int(0, plan.size() - 1);
      const Vector2d displaced = drawn_point(300);
      const Neighbours seen = heard(plan, own, drawn_motion(), displaced);
      const Target target = pairwise->step({seen, own}, plan);
      RC_ASSERT(target.reason == Reason::placed);
      RC_ASSERT((target.position + displaced).norm() < 1e-8);
    }));
  }
}

TEST(PairwiseReferencing, HoldsWithoutAPairItKnows) {
  const auto pairwise = behaviour(pairwise_kind);
  EXPECT_EQ(pairwise->step({{}, 0}, triangle).reason, Reason::no_neighbour);
  const Neighbours one{{{50, 0}, 0.0, 1}, {{70, 0}, 0.0, anonymous}};
  EXPECT_EQ(pairwise->step({one, 0}, triangle).reason, Reason::one_neighbour);
  const Neighbours strangers = without_ids(heard(triangle, 0, {}, {9, 9}));
  const Target target = pairwise->step({strangers, 0}, triangle);
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(PairwiseReferencing, HoldsBetweenCoincidentNeighbours) {
  const Neighbours seen{{{50, 0}, 0.0, 1}, {{50, 0}, 0.0, 2}};
  EXPECT_EQ(behaviour(pairwise_kind)->step({seen, 0}, triangle).reason, Reason::degenerate);
}

TEST(PairwiseReferencing, PlacesAVehicleInALineOfOthers) {
  const Plan line = plan_of({{0, 0}, {100, 0}, {200, 0}, {300, 0}});
  const Neighbours seen = heard(line, 1, rotation(2.0), {7, 7});
  const Target target = behaviour(pairwise_kind)->step({seen, 1}, line);
  EXPECT_LT((target.position + Vector2d(7, 7)).norm(), 1e-10);
}

TEST(PairwiseReferencing, NeverReflectsThePlan) {
  // Neighbours 1 and 2 have changed places: the slot is on the other side of them.
  const Neighbours seen{{{50, -100}, 0.0, 1}, {{-50, -100}, 0.0, 2}};
  const Target target = behaviour(pairwise_kind)->step({seen, 0}, triangle);
  EXPECT_LT((target.position - Vector2d(0, -200)).norm(), 1e-12);
}

}  // namespace
}  // namespace shoal::formations
