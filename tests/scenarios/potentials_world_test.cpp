// Vehicles in six degrees of freedom, obstacles and waypoints in a simulated sea.

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/scenarios/estimators/estimator.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::scenarios {
namespace {

Scenario scenario(const std::string& name, const std::vector<std::string>& sets) {
  Setting root = read_toml(find_scenario(name));
  for (const std::string& set : sets) apply_set(root, set);
  return read_scenario(root);
}

const std::vector<std::string> perfect{"swarm.vehicle.nps_auv.estimator.kind=perfect",
                                       "swarm.vehicle.nps_auv.disturbance.on=false",
                                       "waypoint.ends_trial=false"};

std::vector<std::string> and_also(std::vector<std::string> sets, const std::string& set) {
  sets.push_back(set);
  return sets;
}

/// The final state of a run, bit for bit.
std::vector<double> end_of(const Scenario& s, int threads = 1) {
  World world(s, threads);
  world.run({});
  std::vector<double> all = world.swarm().x_m;
  for (const std::vector<double>& more :
       {world.swarm().y_m, world.swarm().depth_m, world.swarm().heading_rad}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

std::string complaint(const std::string& name, const std::vector<std::string>& sets) {
  try {
    const World world(scenario(name, sets));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NpsAuvSwarm, GivesTheSameBitsForAnyNumberOfThreads) {
  // Blocks hold 64 vehicles; these do not hear one another.
  const std::vector<std::string> many{"plan.square={rows=9,columns=10,separation_m=1000}",
                                      "swarm.start.kind=plan", "trial.duration_s=20",
                                      "waypoint.x_m=0"};
  const Scenario s = scenario("potentials_channel", and_also(many, "obstacle=[]"));
  EXPECT_EQ(end_of(s, 1), end_of(s, 3));
}

TEST(NpsAuvSwarm, IsDrivenByABehaviourOfTheThesis) {
  const Scenario s = scenario("construction_square",
                              {"swarm.vehicle.kind=nps_auv", "plan.square={rows=2,columns=2}",
                               "swarm.start.box.side_m=400", "trial.duration_s=3600"});
  World world(s);
  double worst_s = 0.0;
  world.run({});
  for (std::size_t i = 0; i < world.size(); ++i) {
    worst_s = std::max(worst_s, world.planner(i).target_from(world.swarm().own_position(i)).norm());
    EXPECT_GT(world.logbook(i).distance_m, 30.0);
  }
  EXPECT_LT(worst_s, 2.0 * *world.guidance().drifting_radius_m());
}

TEST(NpsAuvSwarm, DriftsWithTheCurrent) {
  const Scenario s = scenario(
      "potentials_channel",
      {"swarm.vehicle.nps_auv.estimator.kind=perfect", "swarm.vehicle.nps_auv.disturbance.on=false",
       "current.kind=uniform", "current.uniform={u_m_s=0.2,v_m_s=-0.1}", "trial.duration_s=100",
       "behaviour.kind=rigid_registration", "planner.update=ping", "waypoint.ends_trial=false",
       "guidance.kind=drift", "plan.square.separation_m=30",
       "guidance.drift.drifting_radius_m=5000", "obstacle=[]"});
  World world(s);
  const std::vector<double> x = world.swarm().x_m, y = world.swarm().y_m;
  world.run({});
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_NEAR(world.swarm().x_m[i] - x[i], 20.0, 1e-6);
    EXPECT_NEAR(world.swarm().y_m[i] - y[i], -10.0, 1e-6);
  }
}

TEST(NpsAuvSwarm, RefusesStepsThatDoNotFit) {
  EXPECT_NE(complaint("potentials_channel", {"swarm.vehicle.nps_auv.step_s=0.3"})
                .find("controller_period_s is 0.1 s; it must be a multiple of step_s = 0.3 s"),
            std::string::npos);
  EXPECT_NE(complaint("potentials_channel",
                      {"trial.tick_s=0.02", "guidance.conditioned_force.period_s=0.02"})
                .find("trial.tick_s must be a multiple of the vehicle's step_s"),
            std::string::npos);
}

TEST(VirtualPotentials, HoldTheSquareAndBringItToTheWaypoint) {
  World world(scenario("potentials_channel", perfect));
  world.run({});
  for (std::size_t i = 0; i < world.size(); ++i) {
    EXPECT_GT(world.arrived_s(i), 300.0);
    EXPECT_LT(world.arrived_s(i), 400.0);
    EXPECT_NEAR(world.swarm().speed_m_s[i], 0.0, 0.05) << "parked";
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = std::hypot(world.swarm().x_m[i] - world.swarm().x_m[j],
                                      world.swarm().y_m[i] - world.swarm().y_m[j]);
      EXPECT_GT(apart, 28.0);
      EXPECT_LT(apart, 45.0);
    }
  }
}

TEST(VirtualPotentials, EndTheTrialOnArrivalIfAsked) {
  World world(scenario("potentials_channel", and_also(perfect, "waypoint.ends_trial=true")));
  world.run({});
  double last_s = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i) last_s = std::max(last_s, world.arrived_s(i));
  EXPECT_EQ(world.time_s(), last_s);
  EXPECT_LT(world.time_s(), 400.0);
}

TEST(VirtualPotentials, EndTheTrialAtTheSameTimeWhoeverLooks) {
  const Scenario s =
      scenario("potentials_channel",
               and_also(and_also(perfect, "waypoint.ends_trial=true"), "ping.period_s=7"));
  struct Looker final : Observer {
    double every_s() const override { return 0.5; }
    void observe(const World&) override {}
  } looker;
  Observer* observers[] = {&looker};
  World alone(s), watched(s);
  alone.run({});
  watched.run(observers);
  EXPECT_EQ(alone.time_s(), watched.time_s());
}

TEST(VirtualPotentials, AreABehaviourOfTheDrifterToo) {
  World world(scenario(
      "potentials_channel",
      {"swarm.vehicle.kind=drifter", "swarm.vehicle.drifter.max_speed_m_s=2",
       "swarm.vehicle.drifter.speed_step_m_s=0", "swarm.vehicle.drifter.course_step_deg=0",
       "swarm.vehicle.drifter.heading_noise_deg_s=0", "swarm.vehicle.drifter.heading_gain=8"}));
  world.run({});
  for (std::size_t i = 0; i < world.size(); ++i) EXPECT_GT(world.arrived_s(i), 0.0);
}

TEST(VirtualPotentials, AsAProblemLeadVehiclesToTheWaypointToo) {
  World world(scenario(
      "potentials_channel",
      and_also(and_also(perfect, "behaviour.kind=virtual_potential_step"), "guidance.kind=drift")));
  world.run({});
  for (std::size_t i = 0; i < world.size(); ++i) EXPECT_GT(world.arrived_s(i), 0.0);
}

TEST(VirtualPotentials, SurviveAMinuteWithoutAnySensor) {
  World world(scenario("potentials_channel",
                       {"swarm.vehicle.nps_auv.estimator.ukf.sensors.outage_from_s=100",
                        "swarm.vehicle.nps_auv.estimator.ukf.sensors.outage_s=60"}));
  struct Looker final : Observer {
    int blind = 0;
    double every_s() const override { return 5.0; }
    void observe(const World& seen) override {
      blind += seen.swarm().estimate(0)->faulty.all() ? 1 : 0;
    }
  } looker;
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_EQ(looker.blind, 12) << "the record tells it";
  for (std::size_t i = 0; i < world.size(); ++i) EXPECT_GT(world.arrived_s(i), 0.0);
}

TEST(Obstacles, MustNotCoverStartsOrTheWaypoint) {
  const auto says = [](const std::vector<std::string>& sets, const std::string& what) {
    const std::string why = complaint("potentials_channel", sets);
    const std::string file = find_scenario("potentials_channel").string() + ":";
    EXPECT_EQ(why.substr(0, file.size()), file) << "with a line";
    EXPECT_NE(why.find(what), std::string::npos) << why;
  };
  says({"swarm.start.points.points=[[200,100],[15,-15],[-14,15],[15,15.5]]"},
       ": obstacle 1 (rectangle) covers the start of NODE_1 at (200, 100); move one of the two");
  says({"waypoint.x_m=250", "waypoint.y_m=-100"},
       ": obstacle 2 (rectangle) covers the waypoint at (250, -100); move one of the two");
}

TEST(Obstacles, AreNotMetByVehiclesThatPassThem) {
  World world(scenario("potentials_clutter", perfect));
  struct Looker final : Observer {
    double least_m = 1e9;
    double every_s() const override { return 0.5; }
    void observe(const World& seen) override {
      for (std::size_t i = 0; i < seen.size(); ++i) {
        for (const auto& obstacle : seen.obstacles()) {
          const Eigen::Vector2d place(seen.swarm().x_m[i], seen.swarm().y_m[i]);
          least_m = std::min(least_m, obstacle->nearest(place).distance);
        }
      }
    }
  } looker;
  Observer* observers[] = {&looker};
  world.run(observers);
  EXPECT_GT(looker.least_m, 5.0);
  for (std::size_t i = 0; i < world.size(); ++i) EXPECT_GT(world.arrived_s(i), 0.0);
}

TEST(GridStart, FillsRowsFromTheSouthWest) {
  const std::vector<std::string> grid{"plan.square={rows=2,columns=3}", "swarm.start.kind=grid",
                                      "swarm.start.grid.columns=3", "swarm.start.grid.x_m=100",
                                      "swarm.start.grid.spacing_m=20"};
  const World world(scenario("construction_square", grid));
  EXPECT_EQ(world.swarm().x_m, (std::vector<double>{80, 100, 120, 80, 100, 120}));
  EXPECT_EQ(world.swarm().y_m, (std::vector<double>{-10, -10, -10, 10, 10, 10}));
  EXPECT_NE(complaint("construction_square", and_also(grid, "swarm.start.grid.columns=4"))
                .find("swarm.start.grid has 4 columns, which do not divide the plan's 6 slots"),
            std::string::npos);
}

TEST(Waypoints, WantTargetsThatAreRenewedByTheClock) {
  EXPECT_NE(complaint("potentials_channel", {"planner.update=ping"})
                .find("leads vehicles that hear no other, too; set planner.update = \"tick\""),
            std::string::npos);
}

}  // namespace
}  // namespace shoal::scenarios
