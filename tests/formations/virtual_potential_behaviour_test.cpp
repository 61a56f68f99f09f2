// The behaviours virtual_potential and virtual_potential_step.

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/formations/conditioning.hpp"
#include "shoal/formations/fields/virtual_potential.hpp"
#include "shoal/formations/obstacles/shapes.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const Plan square = square_lattice(2, 2, 30.0);

TEST(VirtualPotentialBehaviour, GivesTheForceOfItsPotential) {
  const std::shared_ptr<const Obstacle> circle = std::make_shared<Circle>(Vector2d(60, 10), 15.0);
  const OwnState own{.position = {20, 5}, .velocity = {1.2, 0.1}, .heading_rad = 0.1};
  const Neighbours others{{{0, 30}, 0.0, anonymous, {1.0, 0.0}, 0.2},
                          {{900, 0}, 0.0, anonymous, {0.0, 0.0}, 0.0}};
  const Target target =
      behaviour("virtual_potential")->step({others, 0, own, {&circle, 1}, {300, 0}}, square);
  const VirtualPotential potential({}, {300, 0}, {&circle, 1});
  const Agent near{{20, 35}, 0.2};  // the other one is out of range
  ASSERT_TRUE(target.force_m_s2);
  EXPECT_LT((*target.force_m_s2 - potential.force(own.position, own.velocity, {&near, 1})).norm(),
            1e-12);
  EXPECT_EQ(target.cost, potential.potential(own.position, {&near, 1}).value);
}

TEST(VirtualPotentialBehaviour, LooksAheadForAllVehiclesAlike) {
  // In a swarm that moves as one, the lead changes what is fixed in the sea only.
  const Vector2d together(1.3, -0.2);
  const OwnState own{.position = {20, 5}, .velocity = together};
  const Neighbours others{{{0, 30}, 0.0, anonymous, together, 0.0}};
  const auto cells_only = [&](double lead_s) {
    const auto made =
        behaviour("virtual_potential", {{"lead_s", lead_s}, {"gains.waypoint.pull_m_s2", 0.0}});
    return *made->step({others, 0, own, {}, {500, 0}}, square).force_m_s2;
  };
  EXPECT_LT((cells_only(0.0) - cells_only(8.0)).norm(), 1e-12);

  // One that closes in is repelled, or drawn, earlier.
  const Neighbours closing{{{0, 30}, 0.0, anonymous, {1.3, -2.2}, 0.0}};
  const auto made = behaviour("virtual_potential", {{"lead_s", 5.0}});
  const OwnState later{.position = own.position + 5.0 * together, .velocity = together};
  const Neighbours then{{{0, 20}, 0.0, anonymous, {1.3, -2.2}, 0.0}};
  const auto unled = behaviour("virtual_potential");
  EXPECT_LT((*made->step({closing, 0, own, {}, {500, 0}}, square).force_m_s2 -
             *unled->step({then, 0, later, {}, {500, 0}}, square).force_m_s2)
                .norm(),
            1e-12);
}

TEST(VirtualPotentialStep, GoesToTheMinimumWithinReach) {
  const auto made = behaviour("virtual_potential_step", {{"reach_m", 25.0}});
  const Vector2d waypoint(500, 0);
  const Target ahead = made->step({{}, 0, {.position = {0, 0}}, {}, waypoint}, square);
  EXPECT_NEAR(ahead.position.x(), 25.0, 1e-6) << "as far as it may";
  const Target there = made->step({{}, 0, {.position = {495, 2}}, {}, waypoint}, square);
  EXPECT_NEAR(there.position.x(), 5.0, 1e-4);
  EXPECT_NEAR(there.position.y(), -2.0, 1e-4);
}

TEST(VirtualPotentialStep, RefusesASolverWithoutBounds) {
  try {
    behaviour("virtual_potential_step", {{"solver.kind", "ceres.lbfgs"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("choose a solver for two unknowns with bounds"),
              std::string::npos)
        << error.what();
  }
}

TEST(VirtualPotentialBehaviour, HoldsWhereTheForceIsNoNumber) {
  const Neighbours lost{{{NAN, 0}, 0.0, anonymous}};
  const Target target = behaviour("virtual_potential")->step({lost, 0}, square);
  EXPECT_TRUE(target.held() || target.force_m_s2->allFinite());
}

TEST(Commanded, TurnsAForceIntoSpeedAndHeading) {
  const PerformanceEnvelope envelope;
  const OwnState own{.heading_rad = 2.0, .speed_m_s = 1.0, .turn_rate_rad_s = 0.01};
  const Vector2d ahead(std::cos(2.0), std::sin(2.0)), left(-ahead.y(), ahead.x());
  const Command faster = commanded(0.02 * ahead, own, 0.5, envelope);
  EXPECT_TRUE(faster.thrust);
  EXPECT_NEAR(faster.speed_m_s, 1.01, 1e-12);
  EXPECT_NEAR(faster.acceleration_m_s2, 0.02, 1e-12);
  EXPECT_NEAR(faster.heading_rad, 2.0, 1e-2);
  const Command turning = commanded(0.02 * left, own, 0.5, envelope);
  EXPECT_GT(turning.heading_rad, 2.0) << "counter-clockwise";
  EXPECT_GT(turning.turn_rate_rad_s, 0.0);
}

}  // namespace
}  // namespace shoal::formations
