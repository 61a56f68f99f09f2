#include "shoal/formations/ping_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shoal/core/angles.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;

const Vector2d origin = Vector2d::Zero();

Ping ping(double time_s, double range_m, double bearing_deg, int slot = 1) {
  return {.time_s = time_s, .range_m = range_m, .bearing_rad = radians(bearing_deg), .slot = slot};
}

/// The only neighbour that the filter knows.
Neighbour only(PingFilter& filter, double time_s, const Vector2d& own = origin) {
  const auto all = filter.neighbours(time_s, own);
  EXPECT_EQ(all.size(), 1u);
  return all.empty() ? Neighbour{} : all.front();
}

void expect_at(const Vector2d& position, double x, double y, double tolerance_m = 1e-9) {
  EXPECT_NEAR(position.x(), x, tolerance_m);
  EXPECT_NEAR(position.y(), y, tolerance_m);
}

// Averaging: Rypkema 2015, Alg. 3 -----------------------------------------------------------------

TEST(PingFilter, WeighsPingsByTheirFreshness) {
  PingFilter filter;
  for (int i = 0; i < 4; ++i) filter.receive(ping(30.0 * i, 100.0 * (i + 1), 0.0), origin);
  // Ages 90, 60, 30, 0 s of 120 s: weights .25, .5, .75, 1; (25 + 100 + 225 + 400) / 2.5.
  expect_at(only(filter, 90.0).position, 300.0, 0.0);
}

TEST(PingFilter, DropsPingsFromTheAverageAtTheTimeOut) {
  PingFilter filter;
  for (int i = 0; i < 5; ++i) filter.receive(ping(30.0 * i, i == 0 ? 9e9 : 100.0 * i, 0.0), origin);
  expect_at(only(filter, 120.0).position, 300.0, 0.0, 1e-12);
}

TEST(PingFilter, StartsAnewWhenOnlyTheNewestPingIsYoungEnough) {
  PingFilter filter({.timeout_s = 20.0, .contact_timeout_s = 1000.0});
  filter.receive(ping(0.0, 100.0, 0.0), origin);
  filter.receive(ping(500.0, 300.0, 90.0), origin);
  expect_at(only(filter, 500.0).position, 0.0, 300.0);
}

TEST(PingFilter, AveragesBearingsAsDirections) {
  PingFilter filter({.timeout_s = 1e9});  // equal weights
  filter.receive(ping(0.0, 100.0, 30.0), origin);
  filter.receive(ping(1e-6, 100.0, 90.0), origin);
  // Range and bearing are averaged apart: the mean of the two points would be nearer than 100 m.
  expect_at(only(filter, 1e-6).position, 50.0, 100.0 * std::sqrt(0.75));
}

TEST(PingFilter, AveragesBearingsAcrossTheCut) {
  PingFilter filter({.timeout_s = 1e9});
  filter.receive(ping(0.0, 100.0, 179.0), origin);
  filter.receive(ping(1e-6, 100.0, -179.0), origin);
  expect_at(only(filter, 1e-6).position, -100.0, 0.0);
}

TEST(PingFilter, BelievesTheNewestOfOppositeBearings) {
  PingFilter filter({.timeout_s = 1e9});
  filter.receive(ping(0.0, 100.0, 0.0), origin);
  filter.receive(ping(0.0, 200.0, 180.0), origin);
  expect_at(only(filter, 0.0).position, -150.0, 0.0);
}

TEST(PingFilter, ProjectsTheSlantRangeOntoTheHorizontal) {
  PingFilter filter;
  Ping slanting = ping(0.0, 200.0, 90.0);
  slanting.elevation_rad = radians(60.0);
  filter.receive(slanting, origin);
  expect_at(only(filter, 0.0).position, 0.0, 100.0);

  slanting.elevation_rad = radians(-60.0);  // the mean elevation is the horizontal
  filter.receive(slanting, origin);
  expect_at(only(filter, 0.0).position, 0.0, 200.0);
}

// Contacts --------------------------------------------------------------------------------------

TEST(PingFilter, ForgetsANeighbourUnheardForTheContactTimeOut) {
  PingFilter filter({.contact_timeout_s = 60.0});
  filter.receive(ping(0.0, 100.0, 0.0), origin);
  EXPECT_EQ(filter.neighbours(60.0, origin).size(), 1u);
  EXPECT_EQ(filter.neighbours(60.001, origin).size(), 0u);
}

TEST(PingFilter, RemembersNothingOfAForgottenNeighbourThatReturns) {
  PingFilter filter({.timeout_s = 1000.0, .contact_timeout_s = 60.0});
  filter.receive(ping(0.0, 100.0, 0.0), origin);
  filter.receive(ping(100.0, 300.0, 0.0), origin);
  expect_at(only(filter, 100.0).position, 300.0, 0.0);
}

TEST(PingFilter, TakesASenderAtItsWordIfThePingCarriesItsState) {
  PingFilter filter;
  const OwnState said{.position = {100, 50}, .velocity = {1.0, -0.5}, .heading_rad = 0.3};
  filter.receive({.time_s = 10.0, .range_m = 7.0, .bearing_rad = 2.0, .slot = 1, .state = said},
                 {20, 30});
  const Neighbour now = filter.neighbours(12.0, {25, 30})[0];
  EXPECT_EQ(now.position, Eigen::Vector2d(100 + 2.0 - 25, 50 - 1.0 - 30))
      << "and goes on as it did";
  EXPECT_EQ(now.velocity, said.velocity);
  EXPECT_EQ(now.heading_rad, 0.3);
  EXPECT_EQ(now.age_s, 2.0);

  // A later ping without a state is measured again.
  filter.receive({.time_s = 13.0, .range_m = 7.0, .bearing_rad = 2.0, .slot = 1}, {25, 30});
  const Neighbour measured = filter.neighbours(13.0, {25, 30})[0];
  EXPECT_NEAR(measured.position.norm(), 7.0, 1e-9);
  EXPECT_EQ(measured.velocity, Eigen::Vector2d(0, 0));
}

TEST(PingFilter, TellsTheAgeOfTheLastPing) {
  PingFilter filter;
  filter.receive(ping(0.0, 100.0, 0.0), origin);
  filter.receive(ping(30.0, 100.0, 0.0), origin);
  EXPECT_EQ(only(filter, 47.5).age_s, 17.5);
}

TEST(PingFilter, FollowsTheOwnMotionBetweenPings) {
  PingFilter filter;
  filter.receive(ping(0.0, 100.0, 0.0), {1000.0, 500.0});
  expect_at(only(filter, 10.0, {1030.0, 460.0}).position, 70.0, 40.0);
}

TEST(PingFilter, DoesNotCareWhereTheFrameOfOwnPositionsLies) {
  for (const Vector2d& place : {Vector2d(0, 0), Vector2d(-7e4, 3e4)}) {
    PingFilter filter;
    filter.receive(ping(0.0, 100.0, 10.0), place);
    filter.receive(ping(30.0, 130.0, 20.0), place + Vector2d(5, 5));
    // Weights .75 and 1 of relative measurements, seen from the second place.
    const double bearing = std::atan2(.75 * std::sin(radians(10.0)) + std::sin(radians(20.0)),
                                      .75 * std::cos(radians(10.0)) + std::cos(radians(20.0)));
    const double range = (.75 * 100.0 + 130.0) / 1.75;
    expect_at(only(filter, 31.0, place + Vector2d(6, 6)).position, range * std::cos(bearing) - 1.0,
              range * std::sin(bearing) - 1.0, 1e-10);
  }
}

TEST(PingFilter, KeepsNeighboursInTheOrderInWhichTheyWereFirstHeard) {
  PingFilter filter({.contact_timeout_s = 60.0});
  for (const int slot : {7, 3, 5}) filter.receive(ping(0.0, 100.0, 0.0, slot), origin);
  filter.receive(ping(50.0, 100.0, 0.0, 5), origin);
  filter.receive(ping(50.0, 100.0, 0.0, 7), origin);
  const auto slots = [&](double time_s) {
    std::vector<int> all;
    for (const Neighbour& n : filter.neighbours(time_s, origin)) all.push_back(n.slot);
    return all;
  };
  EXPECT_EQ(slots(50.0), (std::vector{7, 3, 5}));
  EXPECT_EQ(slots(70.0), (std::vector{7, 5}));  // 3 is forgotten
  filter.receive(ping(80.0, 100.0, 0.0, 3), origin);
  EXPECT_EQ(slots(80.0), (std::vector{7, 5, 3}));
}

// Pings without ids -----------------------------------------------------------------------------

TEST(PingFilter, GivesAPingWithoutIdToTheTrackInsideTheGate) {
  PingFilter filter({.timeout_s = 1e9, .gate_m = 50.0});
  filter.receive(ping(0.0, 100.0, 0.0, anonymous), origin);
  filter.receive(ping(30.0, 149.0, 0.0, anonymous), origin);
  expect_at(only(filter, 30.0).position, 124.5, 0.0, 1e-4);
  EXPECT_EQ(only(filter, 30.0).slot, anonymous);
}

TEST(PingFilter, BeginsANewTrackOutsideTheGate) {
  PingFilter filter({.gate_m = 50.0});
  filter.receive(ping(0.0, 100.0, 0.0, anonymous), origin);
  filter.receive(ping(30.0, 151.0, 0.0, anonymous), origin);
  const auto all = filter.neighbours(30.0, origin);
  ASSERT_EQ(all.size(), 2u);
  expect_at(all[0].position, 100.0, 0.0);
  expect_at(all[1].position, 151.0, 0.0);
}

TEST(PingFilter, KeepsNeighboursApartThatAreCloserThanTheGate) {
  PingFilter filter({.gate_m = 150.0, .rest_s = 2.5});
  for (const double time_s : {0.0, 30.0, 60.0}) {
    filter.receive(ping(time_s + 0.10, 100.0, 0.0, anonymous), origin);
    filter.receive(ping(time_s + 0.11, 120.0, 0.0, anonymous), origin);
  }
  const auto all = filter.neighbours(61.0, origin);
  ASSERT_EQ(all.size(), 2u);  // no vehicle pings twice within the rest
  expect_at(all[0].position, 100.0, 0.0);
  expect_at(all[1].position, 120.0, 0.0);
}

TEST(PingFilter, PrefersTheNearestOfSeveralTracks) {
  PingFilter filter({.gate_m = 150.0});
  filter.receive(ping(0.0, 100.0, 0.0, anonymous), origin);
  filter.receive(ping(0.1, 190.0, 0.0, anonymous), origin);
  filter.receive(ping(30.0, 190.0, 0.0, anonymous), origin);
  const auto all = filter.neighbours(30.0, origin);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].age_s, 30.0);
  EXPECT_EQ(all[1].age_s, 0.0);
}

TEST(PingFilter, NeverMixesPingsWithAndWithoutIds) {
  PingFilter filter;
  filter.receive(ping(0.0, 100.0, 0.0, 4), origin);
  filter.receive(ping(30.0, 100.0, 0.0, anonymous), origin);
  filter.receive(ping(60.0, 100.0, 0.0, 4), origin);
  const auto all = filter.neighbours(60.0, origin);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].slot, 4);
  EXPECT_EQ(all[0].age_s, 0.0);
  EXPECT_EQ(all[1].slot, anonymous);
  EXPECT_EQ(all[1].age_s, 30.0);
}

// A lattice of 300 m, 20 vehicles, the own one in the middle and slowly drifting against the rest;
// the pings arrive in another order in every round.
TEST(PingFilter, FindsTheSamePositionsWithAndWithoutIdsInALattice) {
  PingFilter with_ids, without_ids;
  for (int round = 0; round < 12; ++round) {
    const Vector2d own(600.0 + 3.0 * round, 600.0 - 4.0 * round);
    for (int i = 0; i < 20; ++i) {
      const int sender = (i * 7 + round) % 20;
      if (sender == 12) continue;
      const Vector2d away = Vector2d(300.0 * (sender % 5), 300.0 * (sender / 5)) - own;
      Ping p{.time_s = 30.0 * round + 0.01 * i,
             .range_m = away.norm(),
             .bearing_rad = std::atan2(away.y(), away.x()),
             .slot = sender};
      if (p.range_m > 550.0) continue;
      with_ids.receive(p, own);
      p.slot = anonymous;
      without_ids.receive(p, own);
    }
    const auto known = with_ids.neighbours(30.0 * round + 1.0, own);
    const auto unknown = without_ids.neighbours(30.0 * round + 1.0, own);
    ASSERT_EQ(known.size(), unknown.size()) << "round " << round;
    for (std::size_t i = 0; i < known.size(); ++i) {
      EXPECT_EQ(known[i].position, unknown[i].position);
      EXPECT_EQ(known[i].age_s, unknown[i].age_s);
      EXPECT_EQ(unknown[i].slot, anonymous);
    }
  }
}

}  // namespace
}  // namespace shoal::formations
