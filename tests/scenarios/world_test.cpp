#include "shoal/scenarios/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "shoal/scenarios/toml_file.hpp"
#include "tests/scenarios/scenario_of.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::scenarios {
namespace {

using tests::scenario_of;

std::vector<std::string> with(std::vector<std::string> sets, std::vector<std::string> more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

const std::vector<std::string> small{"plan.square={rows=3,columns=3}", "trial.duration_s=600",
                                     "current.kind=vortex", "quality.every_s=0"};

struct Looker final : Observer {
  double interval_s;
  std::function<void(const World&)> look;
  Looker(double every, std::function<void(const World&)> l)
      : interval_s(every), look(std::move(l)) {}
  double every_s() const override { return interval_s; }
  void observe(const World& world) override { look(world); }
};

/// The final state of a run, bit for bit.
struct Final {
  std::vector<double> x, y, heading, energy;
  bool operator==(const Final&) const = default;
};

Final run(const Scenario& s, int threads = 1, double look_every_s = 0.0) {
  World world(s, threads);
  Looker looker(look_every_s, [](const World&) {});
  std::vector<Observer*> observers;
  if (look_every_s > 0.0) observers.push_back(&looker);
  world.run(observers);
  const Swarm& swarm = world.swarm();
  return {swarm.x_m, swarm.y_m, swarm.heading_rad, swarm.propulsion_j};
}

TEST(World, TheSameSeedGivesTheSameBits) {
  EXPECT_EQ(run(scenario_of(small)), run(scenario_of(small)));
  EXPECT_NE(run(scenario_of(small)), run(scenario_of(with(small, {"trial.seed=2"}))));
  EXPECT_NE(run(scenario_of(with(small, {"trial.seed=0"}))),
            run(scenario_of(with(small, {"trial.seed=2"}))));
}

TEST(World, ThreadsDoNotChangeTheNumbers) {
  const Scenario many =
      scenario_of({"plan.square={rows=12,columns=14}", "trial.duration_s=200",
                   "swarm.start.box.side_m=3000", "current.kind=vortex", "quality.every_s=0"});
  const Final one = run(many, 1);
  EXPECT_EQ(one, run(many, 2));
  EXPECT_EQ(one, run(many, 5));
}

TEST(World, APingIsSentAtTheFirstTickThatIsNotBeforeItsTime) {
  World world(scenario_of(with(small, {"trial.duration_s=2", "ping.first_s=0.6"})), 1);
  double sent_s = 0.0;
  Looker looker(0.25, [&](const World& w) {
    if (sent_s == 0.0 && w.logbook(0).pings_sent > 0) sent_s = w.time_s();
  });
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_EQ(sent_s, 0.75);
}

/// Vehicles that take themselves to be somewhere else.
struct Misplaced final : VehicleType {
  static void declare(Options<Misplaced>&) {}

  struct Moving final : Swarm {
    explicit Moving(const std::vector<Start>& starts) : Swarm(starts.size()) {
      for (std::size_t i = 0; i < starts.size(); ++i) {
        x_m[i] = starts[i].x_m;
        y_m[i] = starts[i].y_m;
        heading_rad[i] = starts[i].heading_rad;
        believed_m_.push_back(Eigen::Vector2d(x_m[i], y_m[i]) + error_m(i));
      }
    }
    static Eigen::Vector2d error_m(std::size_t i) {
      return {30.0 - 7.0 * static_cast<double>(i), -20.0};
    }
    formations::OwnState own_state(std::size_t i) const override {
      return {.position = believed_m_[i]};
    }
    void advance(std::size_t first, std::size_t last, std::int64_t,
                 std::span<const formations::Command> commands, std::span<const double> u_m_s,
                 std::span<const double> v_m_s) override {
      for (std::size_t i = first; i < last; ++i) {
        const double way_m = commands[i].thrust ? 0.25 * commands[i].speed_m_s : 0.0;
        x_m[i] += way_m * std::cos(commands[i].heading_rad) + 0.25 * u_m_s[i];
        y_m[i] += way_m * std::sin(commands[i].heading_rad) + 0.25 * v_m_s[i];
        believed_m_[i] = Eigen::Vector2d(x_m[i], y_m[i]) + error_m(i);
      }
    }
  };

  std::optional<std::string> refuses_tick(double) const override { return std::nullopt; }
  std::unique_ptr<Swarm> launch(const std::vector<Start>& starts, const Energy&,
                                const RandomStreams&, double) const override {
    return std::make_unique<Moving>(starts);
  }
};
const Register<VehicleType, Misplaced> registered_vehicle{"misplaced", "a test"};

TEST(World, NeighboursAreLaidAboutWhereTheVehicleBelievesItIs) {
  World world(scenario_of(with(
                  small, {"trial.duration_s=60", "swarm.vehicle.kind=\"misplaced\"",
                          "current.kind=none", "guidance.drift.speed_m_s=1e-6", "ping.range_sd_m=0",
                          "ping.bearing_sd_deg=0", "ping.elevation_sd_deg=0"})),
              1);
  world.run({});
  const Swarm& swarm = world.swarm();
  for (std::size_t i = 0; i < world.size(); ++i) {
    const auto& neighbours = world.planner(i).last_neighbours();
    EXPECT_EQ(neighbours.size(), world.size() - 1);
    for (const formations::Neighbour& n : neighbours) {
      const auto j = static_cast<std::size_t>(n.slot);
      const Eigen::Vector2d there(swarm.x_m[j] - swarm.x_m[i], swarm.y_m[j] - swarm.y_m[i]);
      EXPECT_LT((n.position - there).norm(), 1e-3) << i << ' ' << j;
    }
  }
}

/// rigid_registration for all vehicles that plan at an instant.
struct RigidTogether final : formations::Behaviour {
  static void declare(Options<RigidTogether>&) {}
  static inline std::size_t most = 0;  ///< at once

  std::shared_ptr<const formations::Behaviour> rigid =
      Registry<formations::Behaviour>::instance().make("rigid_registration", {}, "rigid");

  bool needs_ids() const override { return true; }
  bool plans_together() const override { return true; }
  using Behaviour::step;
  formations::Target step(const formations::Neighbourhood& seen, const formations::Plan& plan,
                          const formations::Solving& solving) const override {
    return rigid->step(seen, plan, solving);
  }
  void step_together(std::span<const formations::Neighbourhood> seen, const formations::Plan& plan,
                     std::span<const formations::Solving> solving,
                     std::span<formations::Target> targets) const override {
    most = std::max(most, seen.size());
    Behaviour::step_together(seen, plan, solving, targets);
  }
};
const Register<formations::Behaviour, RigidTogether> registered{"rigid_together", "a test"};

TEST(World, VehiclesThatPlanTogetherMoveAsThoseThatPlanAlone) {
  for (const std::string update : {"ping", "tick"}) {
    const std::vector<std::string> many =
        with(small, {"plan.square={rows=9,columns=9}", "swarm.start.box.side_m=900",
                     "trial.duration_s=150", "ping.loss.independent.probability=0.3",
                     "planner.update=" + update});
    RigidTogether::most = 0;
    EXPECT_EQ(run(scenario_of(with(many, {"behaviour.kind=rigid_together"}))),
              run(scenario_of(with(many, {"behaviour.kind=rigid_registration"}))))
        << update;
    EXPECT_GT(RigidTogether::most, 64u) << update << ": more than a block";
  }
}

TEST(World, AnEmptyBatteryStopsAVehicleIfItLimits) {
  const std::vector<std::string> poor =
      with(small, {"current.kind=uniform", "current.uniform.u_m_s=0.1", "energy.battery_wh=1"});
  const Final rich = run(scenario_of(poor));
  World world(scenario_of(with(poor, {"energy.battery=limits"})));
  std::vector<std::int64_t> pings;
  std::vector<double> x;
  Looker looker(300.0, [&](const World& w) {
    if (w.time_s() != 300.0) return;
    for (std::size_t i = 0; i < w.size(); ++i) {
      pings.push_back(w.logbook(i).pings_sent);
      x.push_back(w.swarm().x_m[i]);
    }
  });
  Observer* observers[] = {&looker};
  world.run(observers);
  ASSERT_EQ(pings.size(), 9u);
  int stopped = 0;
  for (std::size_t i = 0; i < 9; ++i) {
    if (world.empty_s(i) < 0.0 || world.empty_s(i) > 250.0) continue;
    ++stopped;
    EXPECT_TRUE(world.stopped(i));
    EXPECT_FALSE(world.lost(i));
    // Within what a tick draws.
    const double spent_wh = world.propulsion_wh(i) + world.hotel_wh(i) + world.comms_wh(i);
    EXPECT_GE(spent_wh, 1.0);
    EXPECT_LT(spent_wh, 1.0 + 120.0 * 0.25 / joules_per_wh);
    EXPECT_EQ(world.logbook(i).pings_sent, pings[i]);
    EXPECT_NEAR(world.swarm().x_m[i] - x[i], 30.0, 0.1);       // it drifts
    EXPECT_GT(rich.energy[i], world.swarm().propulsion_j[i]);  // ignored, it goes on
  }
  EXPECT_GT(stopped, 4);
}

TEST(World, AnIgnoredBatteryIsOnlyCounted) {
  World world(scenario_of(with(small, {"energy.battery_wh=1"})));
  world.run({});
  EXPECT_EQ(run(scenario_of(small)), run(scenario_of(with(small, {"energy.battery_wh=1"}))));
  EXPECT_GT(world.empty_s(0), 0.0);
  EXPECT_FALSE(world.stopped(0));
}

TEST(World, BeingLookedAtDoesNotChangeTheNumbers) {
  EXPECT_EQ(run(scenario_of(small)), run(scenario_of(small), 1, 1.75));
}

TEST(World, TwoBehavioursMeetTheSameStarts) {
  const auto starts = [](const char* behaviour) {
    const World world(scenario_of(with(small, {std::string("behaviour.kind=") + behaviour})));
    return std::pair(world.swarm().x_m, world.swarm().y_m);
  };
  EXPECT_EQ(starts("rigid_registration"), starts("assignment_registration"));
}

TEST(World, ANewVehicleDoesNotMoveTheOthersStarts) {
  const World nine(scenario_of(small));
  const World twelve(scenario_of(with(small, {"plan.square={rows=3,columns=4}"})));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(nine.swarm().x_m[i], twelve.swarm().x_m[i]);
}

TEST(World, AVehicleThatHearsNoOtherDriftsAndSaysWhy) {
  World world(
      scenario_of({"plan.square={rows=1,columns=2,separation_m=5000}", "swarm.start.kind=plan",
                   "current.kind=uniform", "current.uniform={u_m_s=0.1,v_m_s=0.0}",
                   "trial.duration_s=600", "quality.every_s=0"}));
  world.run({});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(world.planner(i).last_target().reason, formations::Reason::no_neighbour);
    EXPECT_EQ(world.logbook(i).thrusting_s, 0.0);
    EXPECT_NEAR(world.logbook(i).distance_m, 60.0, 1e-9);
    EXPECT_EQ(world.logbook(i).thrust_distance_m, 0.0);
    EXPECT_EQ(world.propulsion_wh(i), 0.0);
    EXPECT_NEAR(world.hotel_wh(i), 1.5 * 600.0 / 3600.0, 1e-12);
    EXPECT_NEAR(world.comms_wh(i), 21 * 2.4 / 3600.0, 1e-12);  // pings at 0, 30, ..., 600 s
  }
}

TEST(World, ForgottenNeighboursLeaveAVehicleDrifting) {
  // All others fall silent at once: two minutes later the last one has no vehicle to go by.
  World world(scenario_of({"plan.square={rows=1,columns=2}", "trial.duration_s=600",
                           "faults.node_loss={every_s=100,count=1}", "quality.every_s=0"}));
  std::vector<formations::Reason> reasons;
  Looker looker(50.0, [&](const World& w) {
    const std::size_t left = w.lost(0) ? 1 : 0;
    reasons.push_back(w.planner(left).last_target().reason);
  });
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_EQ(world.lost_count(), 1u);
  EXPECT_EQ(reasons[3], formations::Reason::placed);        // 150 s
  EXPECT_EQ(reasons[5], formations::Reason::no_neighbour);  // 250 s: last heard at 90 s
  EXPECT_EQ(reasons.back(), formations::Reason::no_neighbour);
}

TEST(World, LosesVehiclesWhenTheScenarioSaysSo) {
  World world(scenario_of(with(small, {"faults.node_loss={every_s=100,count=4}"})));
  std::vector<std::size_t> lost;
  Looker looker(50.0, [&](const World& w) { lost.push_back(w.lost_count()); });
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_EQ(lost, (std::vector<std::size_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4, 4, 4}));
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_EQ(world.hotel_wh(i) < 1.5 * 401.0 / 3600.0, world.lost(i));
  }
}

TEST(World, EveryVehicleMayBeLost) {
  World world(scenario_of(with(small, {"faults.node_loss={every_s=10,count=50}"})));
  world.run({});
  EXPECT_EQ(world.lost_count(), 9u);
}

/// The two vehicles that come first, at one instant.
struct PairLost final : Fault {
  std::int64_t count() const override { return 1; }
  double every_s() const override { return 100.0; }
  void lose(std::span<const std::size_t> left, std::size_t, const RandomStreams&,
            std::vector<std::size_t>& lost) const override {
    lost.assign(left.begin(), left.begin() + 2);
  }
  static void declare(Options<PairLost>&) {}
};
const Register<Fault, PairLost> registered_fault{"test_pair_lost", "two vehicles, once"};

TEST(World, AFaultOfOnesOwnMayTakeSeveralVehicles) {
  World world(scenario_of(with(small, {"faults.kind=test_pair_lost"})));
  world.run({});
  EXPECT_EQ(world.lost_count(), 2u);
  EXPECT_TRUE(world.lost(0) && world.lost(1));
}

TEST(World, StaggeredPingsAreSpreadOverThePeriod) {
  World world(scenario_of(with(small, {"ping.schedule.kind=staggered", "trial.duration_s=29"})));
  std::vector<std::int64_t> sent;
  Looker looker(1.0, [&](const World& w) {
    std::int64_t all = 0;
    for (std::size_t i = 0; i < w.size(); ++i) all += w.logbook(i).pings_sent;
    sent.push_back(all);
  });
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_EQ(sent[0], 1);
  EXPECT_EQ(sent[4], 2);  // one every 3.3 s
  EXPECT_EQ(sent[29], 9);
}

// From a box of 200 m, in which neighbours lie some 40 m from one another, to a lattice of 300 m.
TEST(World, WithoutIdsTheIdFreeBehavioursStillForm) {
  for (const std::string behaviour : {"attraction_repulsion", "assignment_registration"}) {
    const Scenario s =
        scenario_of({"plan.square={rows=3,columns=3}", "trial.duration_s=5400",
                     "behaviour.kind=" + behaviour, "ping.identified=false",
                     "swarm.start.box.side_m=200", "quality.every_s=0", "current.kind=none"});
    World world(s);
    world.run({});
    for (std::size_t i = 0; i < world.size(); ++i) {
      EXPECT_EQ(world.planner(i).last_target().reason, formations::Reason::placed) << behaviour;
      double nearest_m = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < world.size(); ++j) {
        const double away_m = std::hypot(world.swarm().x_m[i] - world.swarm().x_m[j],
                                         world.swarm().y_m[i] - world.swarm().y_m[j]);
        if (i != j) nearest_m = std::min(nearest_m, away_m);
      }
      // Vehicles drift within 20 m of targets that are as uncertain as bearings, 5 degrees of 300
      // m.
      EXPECT_NEAR(nearest_m, 300.0, 90.0) << behaviour << ' ' << i;
    }
  }
}

TEST(World, NothingIsAllocatedInTheSteadyState) {
  for (const std::string behaviour :
       {"rigid_registration", "pairwise_referencing", "assignment_registration"}) {
    World world(scenario_of({"behaviour.kind=" + behaviour, "swarm.start.kind=plan",
                             "trial.duration_s=3000", "current.kind=none", "quality.every_s=0"}));
    std::vector<std::size_t> counts;
    counts.reserve(100);
    Looker looker(100.0, [&](const World&) { counts.push_back(tests::allocations()); });
    Observer* observers[] = {&looker};
    world.run(observers);
    EXPECT_EQ(counts[20], counts[30]) << behaviour;
  }
}

TEST(World, RefusesASwarmOfOne) {
  EXPECT_THROW(World(scenario_of({"plan.square={rows=1,columns=1}"})), InputError);
}

}  // namespace
}  // namespace shoal::scenarios
