// What a planner commands.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shoal/formations/guidances/conditioned_force.hpp"
#include "shoal/formations/guidances/drift.hpp"
#include "tests/formations/engineer.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

using shoal::tests::complaint_of;

TEST(Planner, CommandsWhatItsGuidanceMakesOfTheTarget) {
  Planner planner(shared(cross_plan), behaviour("rigid_registration"), "v0",
                  {.guidance = std::make_shared<Drift>(DriftOptions{.drifting_radius_m = 15.0})});
  EXPECT_FALSE(planner.command({.position = start}).thrust) << "nothing heard yet";
  for (const Neighbour& n : heard(cross_plan, 0, {}, {-20, 0})) {
    planner.receive(ping_of(n, 0.0), start);
  }
  planner.plan(0.5, {.position = start});
  const Command ahead = planner.command({.position = start});  // 16 m to the east
  EXPECT_TRUE(ahead.thrust);
  EXPECT_EQ(ahead.speed_m_s, 1.0);
  EXPECT_NEAR(ahead.heading_rad, 0.0, 1e-9);
  EXPECT_FALSE(planner.command({.position = start + Vector2d(14, 0)}).thrust) << "arrived";
  EXPECT_FALSE(planner.command({.position = start + Vector2d(4, 0)}).thrust) << "and drifting";
}

TEST(Planner, CommandsAForceWithinItsEnvelope) {
  Planner planner(shared(cross_plan), behaviour("virtual_potential"), "v0",
                  {.guidance = std::make_shared<ConditionedForce>(), .waypoint = Vector2d(500, 0)});
  const OwnState own{.position = {0, 0}, .velocity = {1, 0}, .speed_m_s = 1.0};
  const Target target = planner.plan(0.0, own);
  const Command command = planner.command(own);
  const Command expected = commanded(*target.force_m_s2, own, 0.25, {});
  EXPECT_TRUE(command.thrust);
  EXPECT_EQ(command.heading_rad, expected.heading_rad);
  EXPECT_EQ(command.speed_m_s, expected.speed_m_s);
}

TEST(Planner, RefusesPartsThatDoNotFit) {
  const auto plan = shared(cross_plan);
  const std::shared_ptr<const Behaviour> forces = behaviour("pair_forces");
  const std::shared_ptr<const Behaviour> places = behaviour("rigid_registration");
  EXPECT_EQ(
      complaint_of([&] { Planner(plan, forces, "v0", {.guidance = std::make_shared<Drift>()}); }),
      "the behaviour gives forces, and the guidance takes places");
  EXPECT_EQ(complaint_of([&] {
              Planner(plan, places, "v0", {.guidance = std::make_shared<ConditionedForce>()});
            }),
            "the behaviour gives places, and the guidance takes forces");
  EXPECT_EQ(complaint_of([&] { Planner(plan, behaviour("virtual_potential"), "v0"); }),
            "the behaviour leads vehicles to a waypoint, and there is none; give one");
  EXPECT_EQ(complaint_of([&] {
              Planner(plan, behaviour("virtual_potential"), "v0", {.waypoint = Vector2d(1, NAN)});
            }),
            "the waypoint is not finite; give metres east and north");
}

TEST(Planner, RefusesToCommandWithoutGuidanceOrAState) {
  Planner targets_only(shared(cross_plan), behaviour("rigid_registration"), "v0");
  EXPECT_EQ(complaint_of([&] { targets_only.command({}); }),
            "this planner has no guidance, and gives targets only");
  Planner drifting(shared(cross_plan), behaviour("rigid_registration"), "v0",
                   {.guidance = std::make_shared<Drift>()});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string finite = "a command needs a finite own state; the last command holds";
  EXPECT_EQ(complaint_of([&] { drifting.command({.position = {nan, 0}}); }), finite);
  Planner forced(shared(cross_plan), behaviour("pair_forces"), "v0",
                 {.guidance = std::make_shared<ConditionedForce>()});
  EXPECT_EQ(complaint_of([&] { forced.command({.speed_m_s = nan}); }), finite);
}

}  // namespace
}  // namespace shoal::formations
