#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/scenarios/estimators/estimator.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"
#include "tests/analysis/parked_trials.hpp"

namespace shoal::analysis {
namespace {

using namespace test;

Settings both(Settings base, const Settings& more) {
  base.insert(base.end(), more.begin(), more.end());
  return base;
}

/// How long the four need to go around the middle of a vortex together (s).
double around_the_vortex_s() {
  const Setting options;
  const auto vortex =
      Registry<scenarios::Current>::instance().make("vortex", options, "current.vortex");
  const double radius_m = 150.0 * std::numbers::sqrt2;
  double u = 0.0, v = 0.0;
  vortex->sample(0.0, {&radius_m, 1}, std::vector<double>{0.0}, {&u, 1}, {&v, 1});
  return 2.0 * std::numbers::pi * radius_m / v;
}

TEST(Results, KnowTheMeasuresByName) {
  Results results;
  results.add("a_m", 2.5);
  results.add("b_m", std::nullopt);
  EXPECT_EQ(results.at("a_m"), 2.5);
  EXPECT_EQ(results.at("b_m"), std::nullopt);
  EXPECT_THROW(results.at("c_m"), std::out_of_range);
}

TEST(Progress, OfADriftingSwarmIsThatOfTheWater) {
  const Results results =
      run(parked, {"current.kind=uniform", "current.uniform={u_m_s=0.3,v_m_s=-0.4}"}).results;
  EXPECT_NEAR(*results.at("centroid_path_m"), 50.0, 1e-9);
  EXPECT_NEAR(*results.at("centroid_displacement_m"), 50.0, 1e-9);
  EXPECT_NEAR(*results.at("efficiency_m_per_wh"), 50.0 / *results.at("energy_mean_wh"), 1e-9);
}

TEST(Progress, DoesNotCountTheJumpOfTheCentroidWhenAVehicleIsLost) {
  const Results results = run(parked, {"current.kind=uniform", "current.uniform.u_m_s=0.5",
                                       "faults.node_loss={every_s=20,count=2}"})
                              .results;
  // Of twenty looks 5 s apart, the two at the losses have no common centroid.
  EXPECT_NEAR(*results.at("centroid_path_m"), 0.5 * (100.0 - 2 * 5.0), 1e-9);
  EXPECT_EQ(results.at("lost_vehicles"), 2.0);
}

TEST(Energy, OfADriftingVehicleIsHotelLoadAndPings) {
  const Results results = run(parked).results;
  const double hotel_wh = 1.5 * 100.0 / 3600.0;
  const double comms_wh = 4 * 2.4 / 3600.0;  // pings at 0, 30, 60 and 90 s
  EXPECT_NEAR(*results.at("energy_hotel_mean_wh"), hotel_wh, 1e-12);
  EXPECT_NEAR(*results.at("energy_comms_mean_wh"), comms_wh, 1e-12);
  EXPECT_EQ(results.at("energy_propulsion_mean_wh"), 0.0);
  for (const char* name : {"energy_mean_wh", "energy_min_wh", "energy_max_wh"}) {
    EXPECT_NEAR(*results.at(name), hotel_wh + comms_wh, 1e-12) << name;
  }
}

TEST(Energy, IsSpentAtTheRateOfHotelLoadAndPings) {
  const Results results = run(parked).results;
  EXPECT_EQ(results.at("energy_spread_wh"), 0.0);
  // From 40 s on, that is pings at 60 and at 90 s.
  EXPECT_NEAR(*results.at("energy_rate_w"), 1.5 + 2 * 2.4 / 60.0, 1e-9);
}

TEST(Energy, OfThoseLeftIsSpentAtARateOfTheirOwn) {
  const Results results =
      run(parked, {"faults.node_loss={every_s=50,count=1}", "energy.ping_j=0"}).results;
  EXPECT_NEAR(*results.at("energy_rate_w"), 1.5, 1e-9);
}

TEST(Energy, OfNothingHasNoEfficiency) {
  const Results results = run(parked, {"energy.hotel_w=0", "energy.ping_j=0"}).results;
  EXPECT_EQ(results.at("energy_mean_wh"), 0.0);
  EXPECT_EQ(results.at("efficiency_m_per_wh"), std::nullopt);
  EXPECT_TRUE(series(results, "efficiency_m_per_wh").time_s.empty());
}

TEST(Thrust, OfADriftingSwarmIsNone) {
  const Results results =
      run(parked, {"current.kind=uniform", "current.uniform.u_m_s=0.5"}).results;
  for (const char* name :
       {"thrust_time_ratio_mean", "thrust_time_ratio_min", "thrust_time_ratio_max",
        "thrust_time_ratio_spread", "thrust_distance_ratio_mean", "thrust_distance_ratio_min",
        "thrust_distance_ratio_max", "thrust_distance_ratio_spread"}) {
    EXPECT_EQ(results.at(name), 0.0) << name;
  }
}

TEST(Thrust, OfVehiclesThatDoNotMoveHasNoShareOfTheDistance) {
  const Results results = run(parked).results;
  for (const char* name :
       {"thrust_distance_ratio_mean", "thrust_distance_ratio_min", "thrust_distance_ratio_max"}) {
    EXPECT_EQ(results.at(name), std::nullopt) << name;
  }
  EXPECT_TRUE(series(results, "thrust_distance_ratio_mean").time_s.empty());
  EXPECT_FALSE(series(results, "thrust_time_ratio_mean").time_s.empty());
}

TEST(Thrust, OfASwarmThatFormsIsAShare) {
  const Results results =
      run(parked, {"guidance.drift.drifting_radius_m=20", "swarm.start.kind=points",
                   "swarm.start.points.points=[[0,0],[0,50],[50,0],[50,50]]"})
          .results;
  const double mean = *results.at("thrust_time_ratio_mean");
  EXPECT_GT(mean, 0.5);
  EXPECT_LE(*results.at("thrust_time_ratio_min"), mean);
  EXPECT_LE(mean, *results.at("thrust_time_ratio_max"));
  EXPECT_LE(*results.at("thrust_time_ratio_max"), 1.0);
  EXPECT_NEAR(*results.at("thrust_distance_ratio_mean"), 1.0, 1e-4);  // still water
  EXPECT_GT(*results.at("energy_propulsion_mean_wh"), 0.0);
}

TEST(Cohesion, CountsGroupsOutOfEarshotOfOneAnother) {
  const Settings apart = {"swarm.start.kind=points",
                          "swarm.start.points.points=[[0,0],[0,40],[551,0],[551,-60]]"};
  const Results results = run(parked, apart).results;
  EXPECT_EQ(results.at("fragments"), 2.0);
  EXPECT_NEAR(*results.at("min_separation_m"), 40.0, 1e-9);
  EXPECT_EQ(results.at("lost_vehicles"), 0.0);
  EXPECT_EQ(run(parked, {apart[0], apart[1], "ping.range_m=552"}).results.at("fragments"), 1.0);
  EXPECT_EQ(run(parked, {apart[0], apart[1], "ping.range_m=50"}).results.at("fragments"), 3.0);
}

TEST(Cohesion, HasNoSeparationOfVehiclesThatNeverMeet) {
  const Results results =
      run(parked, {"swarm.start.kind=points",
                   "swarm.start.points.points=[[0,0],[0,2000],[2000,0],[2000,2000]]"})
          .results;
  EXPECT_EQ(results.at("min_separation_m"), std::nullopt);
  EXPECT_EQ(results.at("fragments"), 4.0);
}

TEST(Cohesion, OfASwarmThatIsLostAltogether) {
  const Results results = run(parked, {"faults.node_loss={every_s=20,count=4}"}).results;
  EXPECT_EQ(results.at("lost_vehicles"), 4.0);
  EXPECT_EQ(results.at("fragments"), 0.0);
  EXPECT_EQ(results.at("energy_mean_wh"), std::nullopt);
  EXPECT_EQ(results.at("thrust_time_ratio_mean"), std::nullopt);
  EXPECT_EQ(results.at("efficiency_m_per_wh"), std::nullopt);
}

TEST(Quality, OfTheFormationItselfIsZeroAtOnce) {
  const Results results = run(parked).results;
  EXPECT_NEAR(*results.at("quality_final_m"), 0.0, 1e-9);
  EXPECT_NEAR(*results.at("quality_settled_m"), 0.0, 1e-9);
  EXPECT_EQ(results.at("time_to_quality_20m_s"), 0.0);
  EXPECT_NEAR(*results.at("quality_worst_m"), 0.0, 1e-9);
  EXPECT_NEAR(*results.at("quality_trend_m_per_h"), 0.0, 1e-6);
  EXPECT_NEAR(*results.at("energy_to_quality_20m_wh"), 2.4 / 3600.0, 1e-12);  // the first ping
}

TEST(Quality, OfTwoVehiclesIsHalfTheErrorOfTheirDistance) {
  const Results results = run(parked, {"plan.square.rows=1", "swarm.start.kind=points",
                                       "swarm.start.points.points=[[0,0],[400,0]]"})
                              .results;
  EXPECT_NEAR(*results.at("quality_final_m"), 50.0, 1e-9);
  EXPECT_NEAR(*results.at("quality_settled_m"), 50.0, 1e-9);
  EXPECT_NEAR(*results.at("quality_worst_m"), 50.0, 1e-9);
  EXPECT_NEAR(*results.at("quality_last_m"), 50.0, 1e-9);
  EXPECT_EQ(results.at("time_to_quality_20m_s"), std::nullopt);
  EXPECT_EQ(results.at("quality_watched_s"), 100.0);
  EXPECT_EQ(results.at("energy_to_quality_20m_wh"), results.at("energy_mean_wh"));
}

TEST(Quality, KnowsHowStraightVehiclesWentToTheirPlaces) {
  // Where they are is where they should be: no vehicle went anywhere.
  EXPECT_EQ(run(parked).results.at("path_straightness"), std::nullopt);
  // Two vehicles push one another apart, along the line on which they are.
  const Settings apart = {"plan.square.rows=1", "swarm.start.kind=points", "trial.duration_s=600",
                          "guidance.drift.drifting_radius_m=10",
                          "swarm.start.points.points=[[0,0],[100,0]]"};
  const Settings exact = {"ping={range_sd_m=0,bearing_sd_deg=0,elevation_sd_deg=0}"};
  const Results results = run(both(parked, apart), exact).results;
  EXPECT_GT(*results.at("path_straightness"), 0.9);
  EXPECT_LE(*results.at("path_straightness"), 1.0);
  // In a vortex they go the long way round.
  Settings round = exact;
  round.insert(round.end(), {"current.kind=vortex"});
  EXPECT_LT(*run(both(parked, apart), round).results.at("path_straightness"),
            *results.at("path_straightness"));
}

TEST(Quality, IsNotMeasuredUnlessAskedFor) {
  const Results results = run(parked, {"quality.every_s=0"}).results;
  EXPECT_EQ(results.at("quality_final_m"), std::nullopt);
  EXPECT_TRUE(series(results, "quality").time_s.empty());
}

TEST(Quality, OfAnySwarmHasABound) {
  const Results results = run(parked, {"plan.square={rows=30,columns=20}", "trial.duration_s=10",
                                       "swarm.start.kind=box", "swarm.start.box.side_m=3000"})
                              .results;
  EXPECT_GT(*results.at("quality_final_m"), 100.0);
  EXPECT_GE(*results.at("quality_gap_max_m"), 0.0);
  EXPECT_LE(*results.at("quality_gap_max_m"), std::ranges::max(series(results, "quality").values));
  EXPECT_EQ(results.at("quality_gap_max_m"),
            std::ranges::max(series(results, "quality_gap_m").values));
}

TEST(Quality, OfAFormationThatLostVehiclesIsThatOfThoseLeft) {
  // Five of 20 are lost while the formation is built; what is left of it is intact, but its
  // centroid is not where that of the padded plan is.
  const Settings construction = {"trial.duration_s=3600",
                                 "swarm.start.box.side_m=200",
                                 "plan.square={rows=5,columns=4,separation_m=300}",
                                 "behaviour.kind=rigid_registration",
                                 "faults.node_loss={every_s=275,count=5}",
                                 "quality.budget=4000000"};
  for (const char* seed : {"trial.seed=1", "trial.seed=16"}) {
    const Results results = run(both(construction, {seed})).results;
    EXPECT_LT(*results.at("quality_settled_m"), 15.0) << seed;
    EXPECT_LT(*results.at("quality_gap_settled_m"), 0.011) << seed;
    const Results aligned = run(both(construction, {seed, "quality.alignment=centroid"})).results;
    EXPECT_GT(*aligned.at("quality_settled_m"), 50.0) << seed;
    EXPECT_EQ(aligned.at("quality_gap_settled_m"), std::nullopt);
  }
}

TEST(Rotation, IsTheAngleOfThePlanOnTheVehicles) {
  const Trial still = run(parked);
  EXPECT_NEAR(*still.results.at("formation_rotation_deg"), 0.0, 1e-9);
  const Transform2 turned = Transform2::from_angle(radians(35.0), {70.0, -20.0});
  std::string points;
  for (const Eigen::Vector2d& slot : still.world->plan().slots()) {
    const Eigen::Vector2d p = turned * slot;
    points += "[" + shortest(p.x()) + "," + shortest(p.y()) + "],";
  }
  const Results results =
      run(parked, {"swarm.start.kind=points", "swarm.start.points.points=[" + points + "]"})
          .results;
  EXPECT_NEAR(*results.at("formation_rotation_deg"), 35.0, 1e-9);
}

TEST(Rotation, IsFollowedThroughFullTurns) {
  const double period_s = around_the_vortex_s();
  const double duration_s = std::ceil(1.5 * period_s);
  const Results results = run(parked, {"current.kind=vortex", "quality.every_s=0",
                                       "trial.duration_s=" + std::to_string(duration_s)})
                              .results;
  EXPECT_NEAR(*results.at("formation_rotation_deg"), 360.0 * duration_s / period_s, 2.0);
  EXPECT_NEAR(*results.at("centroid_path_m"), 0.0, 1e-6);
}

TEST(Disagreement, IsNoneAmongVehiclesOnThePlan) {
  const Results results =
      run(parked, {"ping={range_sd_m=0,bearing_sd_deg=0,elevation_sd_deg=0}"}).results;
  EXPECT_LT(*results.at("rotation_disagreement_deg"), 1e-4);
  EXPECT_LT(*results.at("rotation_disagreement_first_hour_deg"), 1e-4);
  EXPECT_GT(*run(parked).results.at("rotation_disagreement_deg"), 0.1);
}

TEST(Disagreement, IsThatOfBehavioursThatLayAPlan) {
  const Results results = run(parked, {"behaviour.kind=attraction_repulsion"}).results;
  EXPECT_EQ(results.at("rotation_disagreement_deg"), std::nullopt);
  EXPECT_EQ(results.at("rotation_disagreement_first_hour_deg"), std::nullopt);
  EXPECT_TRUE(series(results, "rotation_disagreement_deg").time_s.empty());
}

TEST(Disagreement, TellsTrialsWhoseVehiclesAgreeFromTheOthers) {
  const Results agreed = run(parked, {"ping.bearing_sd_deg=1"}).results;
  EXPECT_LT(*agreed.at("rotation_disagreement_end_deg"), 360.0 / 4 / 8);
  EXPECT_EQ(agreed.at("agreed_on_rotation"), 1.0);
  EXPECT_EQ(agreed.at("energy_agreed_wh"), agreed.at("energy_mean_wh"));
  EXPECT_EQ(agreed.at("energy_not_agreed_wh"), std::nullopt);

  const Results at_odds = run(parked, {"ping.bearing_sd_deg=90"}).results;
  EXPECT_GT(*at_odds.at("rotation_disagreement_end_deg"), 360.0 / 4 / 8);
  EXPECT_EQ(at_odds.at("agreed_on_rotation"), 0.0);
  EXPECT_EQ(at_odds.at("energy_agreed_wh"), std::nullopt);
  EXPECT_EQ(at_odds.at("energy_not_agreed_wh"), at_odds.at("energy_mean_wh"));

  const Results no_plan = run(parked, {"behaviour.kind=attraction_repulsion"}).results;
  for (const char* name : {"rotation_disagreement_end_deg", "agreed_on_rotation",
                           "energy_agreed_wh", "energy_not_agreed_wh"}) {
    EXPECT_EQ(no_plan.at(name), std::nullopt) << name;
  }
}

/// Two vehicles 30 m apart on their way through open water, with an obstacle aside.
const Settings two_on_their_way = {
    "plan.square={rows=1,columns=2,separation_m=30}",
    "swarm.start.kind=points",
    "swarm.start.points={points=[[0,0],[0,30]],heading_deg=90}",
    "swarm.vehicle.kind=nps_auv",
    "behaviour.kind=virtual_potential",
    "waypoint.x_m=300",
    "waypoint.y_m=15",
    "behaviour.virtual_potential.lead_s=6",
    "planner.update=tick",
    "planner.period_s=0.5",
    "guidance={kind='conditioned_force',conditioned_force={period_s=0.5}}",
    "trial.tick_s=0.5",
    "ping={period_s=0.5,carries_state=true}",
    "trial.duration_s=400",
    "waypoint.radius_m=40",
    "swarm.vehicle.nps_auv.controllers.reverse=true",
    "obstacle=[{shape={kind='circle',circle={x_m=150,y_m=200,radius_m=20}}}]"};

TEST(Passage, TellsWhichVehicleArrivedWhenAndHowTheFormationWasHeld) {
  const Trial trial = run(two_on_their_way);
  const Results& results = trial.results;
  EXPECT_EQ(results.at("arrived_vehicles"), 2.0);
  EXPECT_NEAR(*results.at("arrival_first_s"), 215.0, 25.0);  // 260 m at 1.4 m/s, from rest
  EXPECT_EQ(*results.at("arrival_spread_s"),
            *results.at("arrival_last_s") - *results.at("arrival_first_s"));
  EXPECT_LT(*results.at("cell_error_rms_m"), 3.0);
  EXPECT_GE(*results.at("cell_error_worst_m"), *results.at("cell_error_rms_m"));
  // The northern one keeps about its line, 150 m from the edge of the obstacle.
  EXPECT_NEAR(*results.at("clearance_min_m"), 150.0, 5.0);
  EXPECT_NEAR(*results.at("min_separation_m"), 30.0, 3.0);
  EXPECT_GT(*results.at("control_effort_m_s"), 1.0);  // up to 1.4 m/s, and down again
  const scenarios::Series& error = series(results, "cell_error_m");
  EXPECT_EQ(error.values.front(), 0.0);
  EXPECT_EQ(error.time_s.size(), 81u);
}

TEST(Passage, TellsTheTimeInMotionsThatTheEnvelopeDoesNotKnow) {
  Settings settings = two_on_their_way;
  EXPECT_EQ(*run(settings).results.at("outside_envelope_share"), 0.0);
  // From rest, nothing the envelope allows is within reach until the vehicle does 0.475 m/s.
  settings.push_back("guidance.conditioned_force.envelope={speed_min_m_s=0.5}");
  const double share = *run(settings).results.at("outside_envelope_share");
  EXPECT_GT(share, 0.0);
  EXPECT_LT(share, 0.2);
}

TEST(Passage, IsNotMeasuredWhereThereIsNoWay) {
  const Results results = run(parked).results;
  EXPECT_EQ(results.at("arrived_vehicles"), std::nullopt);
  EXPECT_EQ(results.at("passage_watched_s"), std::nullopt);
  EXPECT_EQ(results.at("cell_error_rms_m"), std::nullopt);
  EXPECT_EQ(results.at("clearance_min_m"), std::nullopt);
  EXPECT_TRUE(series(results, "separation_m").values.empty());
}

TEST(Passage, KnowsWhichVehicleDidNotArrive) {
  const Results results = run(both(two_on_their_way, {"trial.duration_s=100"})).results;
  EXPECT_EQ(results.at("arrived_vehicles"), 0.0);
  EXPECT_EQ(results.at("stranded_share"), 1.0);
  EXPECT_EQ(results.at("arrival_first_s"), std::nullopt);
  EXPECT_EQ(results.at("arrival_last_s"), std::nullopt);
  EXPECT_EQ(results.at("arrival_spread_s"), std::nullopt);
  EXPECT_EQ(results.at("passage_watched_s"), 100.0);
}

TEST(Estimation, OfVehiclesThatKnowTheirStatesIsNotMeasured) {
  EXPECT_EQ(run(two_on_their_way).results.at("position_error_rms_m"), std::nullopt);
}

/// The sums behind the measures of estimation, gathered every 5 s without them.
struct Believed final : scenarios::Observer {
  double squared_m2 = 0.0, nees = 0.0;
  int looks = 0, filtered = 0;

  double every_s() const override { return 5.0; }
  void observe(const scenarios::World& world) override {
    for (std::size_t i = 0; i < world.size(); ++i) {
      const scenarios::Swarm& swarm = world.swarm();
      squared_m2 +=
          (swarm.own_state(i).position - Eigen::Vector2d(swarm.x_m[i], swarm.y_m[i])).squaredNorm();
      ++looks;
      if (world.time_s() == 0.0) continue;
      nees += swarm.estimate(i)->nees;
      ++filtered;
    }
  }
};

TEST(Estimation, TellsErrorsFaultsAndConsistency) {
  const Settings filtered =
      both(two_on_their_way, {"swarm.vehicle.nps_auv.estimator.kind=ukf",
                              "swarm.vehicle.nps_auv.estimator.ukf.doppler=bottom_track"});
  const Results results = run(filtered).results;
  Believed believed;
  scenarios::Observer* const observers[] = {&believed};
  scenarios::World(scenario_of(filtered, {})).run(observers);
  EXPECT_NEAR(*results.at("position_error_rms_m"), std::sqrt(believed.squared_m2 / believed.looks),
              1e-12);
  EXPECT_NEAR(*results.at("nees_mean"), believed.nees / believed.filtered, 1e-10);
  EXPECT_NEAR(*results.at("nees_per_state"), *results.at("nees_mean") / 14.0, 1e-12);
  // Few vehicles and correlated in time: whether filters are consistent is for estimator_test.
  EXPECT_LT(*results.at("position_error_rms_m"), 1.7);
  EXPECT_LT(*results.at("speed_error_rms_m_s"), 0.1);
  EXPECT_LT(*results.at("heading_error_rms_deg"), 4.0);
  EXPECT_GT(*results.at("fault_share"), 0.0);
  EXPECT_LT(*results.at("fault_share"), 0.1);
  const Results blind =
      run(both(two_on_their_way,
               {"swarm.vehicle.nps_auv.estimator.kind=ukf",
                "swarm.vehicle.nps_auv.estimator.ukf.sensors={outage_from_s=0,outage_s=200}"}))
          .results;
  EXPECT_NEAR(*blind.at("fault_share"), 0.5, 0.05);
}

TEST(Series, StandOnInstantsThatTheyShare) {
  const Results results =
      run(parked, {"current.kind=uniform", "current.uniform.u_m_s=0.5"}).results;
  const std::vector<double> instants = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100};
  for (const char* name : {"quality", "energy_mean_wh", "energy_min_wh", "energy_max_wh",
                           "centroid_path_m", "efficiency_m_per_wh"}) {
    EXPECT_EQ(series(results, name).time_s, instants) << name;
  }
  const std::vector<double> later(instants.begin() + 1, instants.end());
  for (const char* of : {"time", "distance"}) {
    for (const char* which : {"mean", "min", "max"}) {
      const std::string name = std::string("thrust_") + of + "_ratio_" + which;
      EXPECT_EQ(series(results, name).time_s, later) << name << ": nothing to share at the start";
    }
  }
  EXPECT_EQ(series(run(parked, {"quality.every_s=0"}).results, "energy_mean_wh").time_s,
            (std::vector<double>{0, 30, 60, 90}));
}

TEST(Series, EndWithTheValue) {
  const Results results =
      run(parked, {"current.kind=uniform", "current.uniform.u_m_s=0.5"}).results;
  for (const scenarios::Series& each : results.series) {
    const auto value = std::ranges::find(results.values, each.name,
                                         &std::pair<std::string, std::optional<double>>::first);
    if (value == results.values.end() || each.name.starts_with("rotation")) continue;
    EXPECT_EQ(value->second, each.values.back()) << each.name;
  }
  EXPECT_EQ(results.at("quality_final_m"), series(results, "quality").values.back());
}

TEST(Trial, HasTheSameMeasuresWithAndWithoutARecord) {
  Setting root;
  for (const std::string& setting : parked) scenarios::apply_set(root, setting);
  scenarios::apply_set(root, "guidance.drift.drifting_radius_m=20");
  const scenarios::Scenario scenario = scenarios::read_scenario(root);
  const Trial recorded = run_trial(scenario, {.record = true});
  const Trial unrecorded = run_trial(scenario, {.record = false});
  EXPECT_NE(recorded.record, nullptr);
  EXPECT_EQ(unrecorded.record, nullptr);
  EXPECT_EQ(recorded.results.values, unrecorded.results.values);
}

}  // namespace
}  // namespace shoal::analysis
