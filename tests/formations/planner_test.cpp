#include "shoal/formations/planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/formations/engineer.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/complaint_of.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;
using shoal::tests::complaint_of;

TEST(Planner, TurnsPingsIntoATarget) {
  Engineer engineer(cross_plan);
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 0.0, start);
  const Target& target = engineer.planner.plan(0.5, {.position = start});
  EXPECT_EQ(target.reason, Reason::placed);
  EXPECT_LT((target.position - Vector2d(16, 0)).norm(), 1e-9);  // 4 of 5 weights
  EXPECT_EQ(&target, &engineer.planner.last_target());
}

TEST(Planner, RefersTheTargetToWhereTheVehicleIsNow) {
  Engineer engineer(cross_plan);
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 0.0, start);
  engineer.planner.plan(0.5, {.position = start});
  EXPECT_LT((engineer.planner.target_from(start) - Vector2d(16, 0)).norm(), 1e-9);
  EXPECT_LT((engineer.planner.target_from(start + Vector2d(16, 3)) - Vector2d(0, -3)).norm(), 1e-9);
}

TEST(Planner, TellsTheBehaviourWhereTheVehicleIs) {
  struct Listener final : Behaviour {
    mutable Vector2d seen_at = Vector2d::Zero();
    Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
      seen_at = seen.own.position;
      return Target::hold(Reason::no_neighbour);
    }
    bool needs_ids() const override { return false; }
  };
  const auto listener = std::make_shared<const Listener>();
  Planner planner(std::make_shared<const Plan>(cross_plan), listener, "v0");
  planner.plan(0.0, {.position = start});
  EXPECT_EQ(listener->seen_at, start);
}

TEST(Planner, PlansFromWhereTheVehicleIsNow) {
  Engineer engineer(cross_plan);
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 0.0, start);
  // Having come 10 m of the way, 10 m are left: 4 of 5 weights see them.
  const Target target = engineer.planner.plan(10.0, {.position = start + Vector2d(10, 0)});
  EXPECT_LT((target.position - Vector2d(8, 0)).norm(), 1e-9);
}

TEST(Planner, HoldsBeforeItHearsAnybodyAndAfterAllHaveGone) {
  Engineer engineer(cross_plan);
  EXPECT_EQ(engineer.planner.last_target().reason, Reason::no_neighbour);
  EXPECT_EQ(engineer.planner.target_from(start), Vector2d(0, 0));
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 0.0, start);
  EXPECT_FALSE(engineer.planner.plan(0.0, {.position = start}).held());
  EXPECT_EQ(engineer.planner.plan(1000.0, {.position = start}).reason, Reason::no_neighbour);
  // Held: drift freely wherever the current takes the vehicle.
  EXPECT_EQ(engineer.planner.target_from(start + Vector2d(50, 0)), Vector2d(0, 0));
}

TEST(Planner, KnowsItsSlotByName) {
  const auto plan = std::make_shared<const Plan>(std::vector<std::string>{"ann", "bea"},
                                                 std::vector<Vector2d>{{0, 0}, {9, 0}});
  const std::shared_ptr<const Behaviour> rigid = behaviour("rigid_registration");
  EXPECT_EQ(Planner(plan, rigid, "bea").own_slot(), 1);
  EXPECT_EQ(complaint_of([&] { Planner(plan, rigid, "cid"); }),
            "the plan has no slot named \"cid\"; it has ann and bea");
}

TEST(Planner, RefusesPingsThatCannotBe) {
  Engineer engineer(cross_plan);
  const auto refusal = [&](Ping ping, const Vector2d& own = Vector2d::Zero()) {
    return complaint_of([&] { engineer.planner.receive(ping, own); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string numbers =
      "a ping needs finite numbers and a range of at least 0 m; drop this one";
  EXPECT_EQ(refusal({.time_s = nan, .slot = 1}), numbers);
  EXPECT_EQ(refusal({.range_m = nan, .slot = 1}), numbers);
  EXPECT_EQ(refusal({.range_m = -0.1, .slot = 1}), numbers);
  EXPECT_EQ(refusal({.bearing_rad = HUGE_VAL, .slot = 1}), numbers);
  EXPECT_EQ(refusal({.elevation_rad = nan, .slot = 1}), numbers);
  EXPECT_EQ(refusal({.slot = 1}, {0, nan}), numbers);
  EXPECT_EQ(refusal({.slot = 1, .state = OwnState{.heading_rad = nan}}), numbers);
  EXPECT_EQ(refusal({.slot = 5}), "a ping says slot 5, but the plan has slots 0 to 4");
  EXPECT_EQ(refusal({.slot = -2}), "a ping says slot -2, but the plan has slots 0 to 4");
  EXPECT_EQ(refusal({.slot = 0}), "a ping carries the own id v0; drop echoes of the own pings");
  EXPECT_EQ(refusal({.slot = 1}), "");
  EXPECT_EQ(refusal({.slot = anonymous}), "");
}

TEST(Planner, RefusesTimesAndStatesThatCannotBeAndKeepsItsTarget) {
  Engineer engineer(cross_plan);
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 5.0, start);
  const Vector2d before = engineer.planner.plan(6.0, {.position = start}).position;
  const auto refusal = [&](double time_s, const OwnState& own) {
    return complaint_of([&] { engineer.planner.plan(time_s, own); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string numbers =
      "planning needs a finite time and a finite own state; the last target holds";
  for (const double time_s : {nan, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_EQ(refusal(time_s, {.position = start}), numbers) << time_s;
  }
  EXPECT_EQ(refusal(7.0, {.position = {nan, 0}}), numbers);
  EXPECT_EQ(refusal(7.0, {.position = start, .heading_rad = nan}), numbers);
  EXPECT_EQ(refusal(5.9, {.position = start}),
            "a plan at t = 5.9 s comes after a ping or a plan of t = 6 s; time must not go back");
  EXPECT_EQ(engineer.planner.last_target().position, before);
  EXPECT_EQ(engineer.planner.plan(6.0, {.position = start}).position, before);
}

TEST(Planner, ForgetsNothingOfARefusedPing) {
  Engineer engineer(cross_plan);
  engineer.hear(heard(cross_plan, 0, {}, {-20, 0}), 0.0, start);
  const Vector2d before = engineer.planner.plan(1.0, {.position = start}).position;
  EXPECT_THROW(engineer.planner.receive({.time_s = 1.0, .range_m = -1.0, .slot = 1}, start),
               InputError);
  EXPECT_EQ(engineer.planner.plan(1.0, {.position = start}).position, before);
}

// Twelve neighbours of a lattice, a ping of each every 30 s.
class PlannerOf : public testing::TestWithParam<std::string> {};

TEST_P(PlannerOf, AllocatesNothingInTheSteadyState) {
  const Plan lattice = square_lattice(5, 4, 300.0);
  Engineer engineer(lattice, GetParam().c_str());
  Neighbours seen = heard(lattice, 0);
  seen.resize(12);

  const auto round = [&](int number) {
    const double time_s = 30.0 * number;
    const Vector2d own = start + number * Vector2d(3, -2);
    const Vector2d drift(-0.3, 0.2);  // the others move less than the own vehicle
    for (Neighbour& n : seen) n.position += drift;
    engineer.hear(seen, time_s, own);
    EXPECT_EQ(engineer.planner.plan(time_s + 0.5, {.position = own}).reason, Reason::placed);
  };
  for (int i = 0; i < 8; ++i) round(i);  // the filters are full
  const std::size_t before = shoal::tests::allocations();
  for (int i = 8; i < 38; ++i) round(i);
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
}

INSTANTIATE_TEST_SUITE_P(Behaviours, PlannerOf,
                         testing::Values("rigid_registration", "pairwise_referencing",
                                         "assignment_registration"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

TEST(AllocationCount, SeesAllocationsOfLibraries) {
#ifdef SHOAL_SANITIZED
  GTEST_SKIP() << "the sanitizers have an operator new of their own";
#endif
  const std::size_t before = shoal::tests::allocations();
  const Plan plan = cross_plan;  // copied by libshoal_formations or here: vectors, in any case
  EXPECT_GT(shoal::tests::allocations(), before);
  const std::size_t between = shoal::tests::allocations();
  const Plan centred = plan.centred();  // a function of the library
  EXPECT_GT(shoal::tests::allocations(), between);
}

/// What plans for several vehicles at once; each call is counted.
struct Counted final : Behaviour {
  std::unique_ptr<Behaviour> rigid = behaviour(rigid_kind);
  mutable std::vector<std::size_t> calls;

  bool needs_ids() const override { return true; }
  bool plans_together() const override { return true; }
  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    return rigid->step(seen, plan, solving);
  }
  void step_together(std::span<const Neighbourhood> seen, const Plan& plan,
                     std::span<const Solving> solving, std::span<Target> targets) const override {
    calls.push_back(seen.size());
    Behaviour::step_together(seen, plan, solving, targets);
  }
};

TEST(Planner, SeveralPlanTogetherWhatEachPlansAlone) {
  const auto plan = std::make_shared<const Plan>(cross_plan);
  const auto counted = std::make_shared<const Counted>();
  struct Watcher final : PlanObserver {
    int answers = 0, plans = 0;
    void answered(const solvers::Answer&, double) override { ++answers; }
    void planned(const Neighbourhood&, const Target&) override { ++plans; }
  } watcher;
  std::vector<Planner> alone, together;
  for (const char* name : {"v0", "v1", "v2"}) {
    alone.emplace_back(plan, counted, name);
    together.emplace_back(plan, counted, name);
  }
  together[1].observe(watcher);
  std::vector<Planner*> all;
  std::vector<OwnState> own;
  for (std::size_t i = 0; i < together.size(); ++i) {
    all.push_back(&together[i]);
    own.push_back({.position = {10.0 * static_cast<double>(i), -3.0}});
    for (int sender = 0; sender < cross_plan.size(); ++sender) {
      if (sender == static_cast<int>(i)) continue;
      const Ping ping{.time_s = 1.0,
                      .range_m = 50.0 + 30.0 * sender,
                      .bearing_rad = 1.1 * sender,
                      .slot = sender};
      alone[i].receive(ping, own[i].position);
      together[i].receive(ping, own[i].position);
    }
  }
  Planner::plan_together(all, 2.0, own);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Target& one = alone[i].plan(2.0, own[i]);
    EXPECT_FALSE(one.held());
    EXPECT_EQ(together[i].last_target().position, one.position);
    EXPECT_EQ(together[i].last_target().cost, one.cost);
    EXPECT_EQ(together[i].last_plan_s(), 2.0);
    EXPECT_EQ(together[i].target_from({1, 1}), alone[i].target_from({1, 1}));
  }
  EXPECT_EQ(counted->calls, std::vector<std::size_t>{3});
  EXPECT_EQ(watcher.answers, 1);
  EXPECT_EQ(watcher.plans, 1);
}

TEST(Planner, ATimeThatGoesBackForOneChangesNone) {
  const auto plan = std::make_shared<const Plan>(cross_plan);
  const auto counted = std::make_shared<const Counted>();
  Planner first(plan, counted, "v0"), second(plan, counted, "v1");
  second.plan(5.0, {});
  Planner* const both[] = {&first, &second};
  const OwnState own[2] = {};
  EXPECT_EQ(complaint_of([&] { Planner::plan_together(both, 4.0, own); }),
            "a plan at t = 4 s comes after a ping or a plan of t = 5 s; time must not go back");
  EXPECT_LT(first.last_plan_s(), 0.0);
  EXPECT_TRUE(counted->calls.empty());
}

}  // namespace
}  // namespace shoal::formations
