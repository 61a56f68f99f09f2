#include "shoal/formations/planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shoal/formations/guidances/conditioned_force.hpp"
#include "shoal/formations/guidances/drift.hpp"
#include "tests/formations/swarm.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/complaint_of.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;
using shoal::tests::complaint_of;

Ping ping_of(const Neighbour& n, double time_s) {
  return {.time_s = time_s,
          .range_m = n.position.norm(),
          .bearing_rad = std::atan2(n.position.y(), n.position.x()),
          .slot = n.slot};
}

/// A planner of vehicle v0, and what its own frame's origin stands for.
struct Engineer {
  std::shared_ptr<const Plan> plan;
  Planner planner;

  explicit Engineer(const Plan& geometry, const char* kind = "rigid_registration")
      : plan(std::make_shared<const Plan>(geometry)),
        planner(plan, std::shared_ptr<const Behaviour>(behaviour(kind)), "v0") {}

  void hear(const Neighbours& all, double time_s, const Vector2d& own) {
    for (const Neighbour& n : all) planner.receive(ping_of(n, time_s), own);
  }
};

const Vector2d start(5000, -2000);

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
    mutable Vector2d told = Vector2d::Zero();
    Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
      told = seen.own.position;
      return Target::hold(Reason::no_neighbour);
    }
    bool needs_ids() const override { return false; }
  };
  const auto listener = std::make_shared<const Listener>();
  Planner planner(std::make_shared<const Plan>(cross_plan), listener, "v0");
  planner.plan(0.0, {.position = start});
  EXPECT_EQ(listener->told, start);
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

// Commands ----------------------------------------------------------------------------------------

std::shared_ptr<const Plan> shared(const Plan& plan) {
  return std::make_shared<const Plan>(plan);
}

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

// Observers ---------------------------------------------------------------------------------------

/// Counts what is shown, and keeps the costs of the answers.
struct Watcher final : PlanObserver {
  int smooth = 0, registration = 0, matching = 0;
  int answers = 0;
  std::vector<double> costs;
  std::vector<Target> targets;

  void answered(const solvers::Answer& answer, double seconds) override {
    ++answers;
    EXPECT_EQ(answer.status, solvers::Status::converged);
    EXPECT_EQ(seconds, 0.0) << "no time was asked for";
  }
  void solved(const solvers::Problem& problem, const solvers::Solution& answer) override {
    ++smooth;
    costs.push_back(answer.cost);
    EXPECT_NEAR(problem.evaluate(answer.x.data()), answer.cost, 1e-9 * std::abs(answer.cost));
  }
  void solved(const solvers::RegistrationProblem& problem,
              const solvers::RegistrationSolution& answer) override {
    ++registration;
    costs.push_back(answer.cost);
    double sum = 0.0;
    for (const solvers::PointPair& p : problem.pairs) {
      sum += p.weight * (answer.T_to_from * p.from - p.to).squaredNorm();
    }
    EXPECT_NEAR(sum, answer.cost, 1e-9 * (1.0 + sum));
  }
  void solved(const solvers::MatchingProblem& problem,
              const solvers::MatchingSolution& answer) override {
    ++matching;
    costs.push_back(answer.cost);
    EXPECT_EQ(problem.points.size(), answer.slot_of_point.size());
  }
  void planned(const Neighbourhood& seen, const Target& target) override {
    EXPECT_EQ(seen.own_slot, 0);
    targets.push_back(target);
  }
};

TEST(Planner, ShowsObserversEachProblemThatItSolvesWithItsAnswer) {
  const Neighbours seen = heard(cross_plan, 0, {}, {-20, 5});
  for (const char* kind : {"rigid_registration", "pairwise_referencing", "attraction_repulsion",
                           "assignment_registration"}) {
    Engineer watched(cross_plan, kind), alone(cross_plan, kind);
    Watcher one, other;
    watched.planner.observe(one);
    watched.planner.observe(other);
    EXPECT_TRUE(watched.planner.plan(0.0, {.position = start}).held());
    EXPECT_TRUE(one.costs.empty()) << "it heard no other vehicle, and solved nothing";
    for (Engineer* each : {&watched, &alone}) each->hear(seen, 1.0, start);
    const Target target = watched.planner.plan(2.0, {.position = start});
    EXPECT_EQ(target.position, alone.planner.plan(2.0, {.position = start}).position) << kind;
    const bool assigns = std::string_view(kind) == "assignment_registration";
    EXPECT_EQ(one.matching, assigns ? 1 : 0) << kind;
    EXPECT_EQ(one.smooth + one.registration, 1) << kind;
    EXPECT_EQ(one.answers, one.smooth + one.registration + one.matching) << kind;
    ASSERT_EQ(one.targets.size(), 2u);
    EXPECT_EQ(one.targets.back().position, target.position);
    EXPECT_EQ(one.costs, other.costs);
  }
}

TEST(Planner, TimesWhatItSolvesIfAnObserverWantsThat) {
  struct Timer final : PlanObserver {
    int answers = 0;
    double seconds = 0.0;
    Wants wants() const override { return {.problems = false, .times = true}; }
    void answered(const solvers::Answer&, double taken) override {
      ++answers;
      seconds += taken;
    }
    using SolveObserver::solved;
    void solved(const solvers::Problem&, const solvers::Solution&) override { ADD_FAILURE(); }
  };
  for (const char* kind : {"rigid_registration", "pairwise_referencing"}) {
    Engineer engineer(cross_plan, kind);
    Timer timer;
    engineer.planner.observe(timer);
    engineer.hear(heard(cross_plan, 0, {}, {-20, 5}), 1.0, start);
    engineer.planner.plan(2.0, {.position = start});
    EXPECT_EQ(timer.answers, 1) << kind;
    EXPECT_GE(timer.seconds, 0.0);
  }
}

// Memory ------------------------------------------------------------------------------------------

/// A vehicle in a lattice that turns, spreads and jitters; `swarm` sets it off from others.
class Wanderer {
 public:
  Wanderer(const char* kind, int swarm)
      : lattice_(square_lattice(4, swarm == 0 ? 4 : 3, 300.0)),
        swarm_(swarm),
        planner_(shared(lattice_), behaviour(kind), "v0", {.guidance = std::make_shared<Drift>()}) {
  }

  /// The target and the command of a step, as numbers.
  std::vector<double> step(int number) {
    const double time_s = 30.0 * number;
    const Vector2d own = start + number * Vector2d(3, -2 * swarm_);
    Neighbours seen = heard(lattice_, 0, rotation(0.02 * number + swarm_), {10.0 * swarm_, 5});
    for (Neighbour& n : seen) {
      n.position += Vector2d(std::sin(7.0 * n.slot + number), std::cos(3.0 * n.slot - number));
      planner_.receive(ping_of(n, time_s), own);
    }
    const Target target = planner_.plan(time_s + 0.5, {.position = own});
    const Command command = planner_.command({.position = own});
    return {target.position.x(), target.position.y(), target.cost, command.heading_rad,
            command.speed_m_s};
  }

 private:
  Plan lattice_;
  int swarm_;
  Planner planner_;
};

class MemoryOfPlanner : public testing::TestWithParam<std::string> {};

TEST_P(MemoryOfPlanner, IsCopiedWithIt) {
  Wanderer original(GetParam().c_str(), 0);
  for (int i = 0; i < 40; ++i) original.step(i);
  Wanderer copy = original;
  Wanderer another = copy;
  for (int i = 40; i < 60; ++i) {
    const auto expected = original.step(i);
    EXPECT_EQ(copy.step(i), expected) << i;
  }
  for (int i = 40; i < 60; ++i) another.step(i);
  EXPECT_EQ(another.step(60), original.step(60));
}

TEST_P(MemoryOfPlanner, IsNotSharedWithAnotherSwarmOnTheThread) {
  std::vector<std::vector<double>> alone[2], alternately[2];
  for (int swarm = 0; swarm < 2; ++swarm) {
    Wanderer wanderer(GetParam().c_str(), swarm);
    for (int i = 0; i < 60; ++i) alone[swarm].push_back(wanderer.step(i));
  }
  Wanderer first(GetParam().c_str(), 0), second(GetParam().c_str(), 1);
  for (int i = 0; i < 60; ++i) {
    alternately[0].push_back(first.step(i));
    alternately[1].push_back(second.step(i));
  }
  EXPECT_EQ(alternately[0], alone[0]);
  EXPECT_EQ(alternately[1], alone[1]);
}

INSTANTIATE_TEST_SUITE_P(Behaviours, MemoryOfPlanner,
                         testing::Values("rigid_registration", "pairwise_referencing",
                                         "assignment_registration", "attraction_repulsion"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

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

}  // namespace
}  // namespace shoal::formations
