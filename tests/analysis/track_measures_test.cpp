#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "shoal/analysis/experiments/measures/energy_linearity.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

using Settings = std::vector<std::string>;

/// Nine vehicles on a square lattice of 300 m that never thrust.
const Settings nine_parked = {"trial.duration_s=600",
                              "plan.square={rows=3,columns=3,separation_m=300}",
                              "swarm.start.kind=plan", "guidance.drift.drifting_radius_m=100000",
                              "quality={every_s=30,layers=1}"};
const Settings exact = {"ping={range_sd_m=0,bearing_sd_deg=0,elevation_sd_deg=0}"};

Results results_of(const std::vector<Settings>& parts) {
  Setting root;
  for (const Settings& part : parts) {
    for (const std::string& setting : part) scenarios::apply_set(root, setting);
  }
  return run_trial(scenarios::read_scenario(root), {.record = false}).results;
}

std::string at(const std::vector<Eigen::Vector2d>& places) {
  std::string list;
  for (const Eigen::Vector2d& p : places) {
    list += (list.empty() ? "[" : ",[") + shortest(p.x()) + "," + shortest(p.y()) + "]";
  }
  return "swarm.start={kind=\"points\",points={points=[" + list + "]}}";
}

std::vector<Eigen::Vector2d> square_places(int rows, int columns) {
  std::vector<Eigen::Vector2d> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) places.emplace_back(300 * column, 300 * row);
  }
  return places;
}

TEST(Paths, OfADriftingSwarmAreStraightAndNeverCross) {
  const Results results =
      results_of({nine_parked, {"current.kind=uniform", "current.uniform={u_m_s=0.3,v_m_s=-0.4}"}});
  EXPECT_NEAR(*results.at("path_length_m"), 300.0, 1e-6);
  EXPECT_NEAR(*results.at("path_detour"), 1.0, 1e-9);
  EXPECT_NEAR(*results.at("approach_straightness"), 1.0, 1e-9);
  EXPECT_NEAR(*results.at("arc_away_m"), 0.0, 1e-6);
  EXPECT_EQ(results.at("arc_share"), 0.0);
  EXPECT_EQ(results.at("crossing_share"), 0.0);
}

TEST(Paths, OfASwarmThatStaysAreNone) {
  const Results results = results_of({nine_parked});
  EXPECT_EQ(results.at("path_length_m"), 0.0);
  EXPECT_EQ(results.at("path_detour"), std::nullopt);
  EXPECT_EQ(results.at("approach_straightness"), std::nullopt);
  EXPECT_EQ(results.at("turning_deg"), std::nullopt);
}

TEST(Paths, OfVehiclesThatChangeTheirCornersCross) {
  std::vector<Eigen::Vector2d> places = square_places(3, 3);
  std::swap(places[0], places[8]);
  const Settings keen = {"guidance.drift.drifting_radius_m=20", "trial.duration_s=1800",
                         "behaviour.kind=rigid_registration", "ping.range_m=2000"};
  EXPECT_EQ(results_of({nine_parked, exact, keen, {at(places)}}).at("crossing_share"), 0.0);
  std::swap(places[2], places[6]);
  const Results results = results_of({nine_parked, exact, keen, {at(places)}});
  EXPECT_GT(*results.at("crossing_share"), 0.0);
}

TEST(Turning, OfAStraightTrackIsNoneAndTellsTheWaters) {
  const Results results =
      results_of({nine_parked, {"current.kind=uniform", "current.uniform={u_m_s=0.3,v_m_s=-0.4}"}});
  EXPECT_NEAR(*results.at("turning_deg"), 0.0, 1e-6);
  EXPECT_NEAR(*results.at("turning_in_current_deg"), 0.0, 1e-6);
  EXPECT_EQ(results.at("turning_in_still_water_deg"), std::nullopt);
}

TEST(Turning, OfDriftersInAVortexIsThatOfTheirCircles) {
  // A step of 10 m and more at 5 s looks; on a circle it turns by the angle that it spans.
  const Results results = results_of({nine_parked,
                                      {"trial.duration_s=7200", "current.kind=vortex",
                                       "plan.square={rows=2,columns=2,separation_m=300}"}});
  const double radius_m = 150.0 * std::numbers::sqrt2;
  const double speed_m_s = 1.0 / (radius_m / 200.0 + 2.0);
  const double step_m = 5.0 * speed_m_s * std::ceil(10.0 / (5.0 * speed_m_s));
  EXPECT_NEAR(*results.at("turning_deg"), step_m / radius_m * 180.0 / std::numbers::pi, 0.1);
}

TEST(CurrentSpeed, IsThatOfTheWater) {
  const Results results = results_of({nine_parked,
                                      {"current.kind=uniform", "guidance.drift.speed_m_s=0.8",
                                       "current.uniform={u_m_s=0.12,v_m_s=-0.16}"}});
  EXPECT_NEAR(*results.at("current_speed_mean_m_s"), 0.2, 1e-12);
  EXPECT_NEAR(*results.at("current_speed_ratio"), 0.25, 1e-12);
  EXPECT_EQ(results_of({nine_parked}).at("current_speed_mean_m_s"), 0.0);
}

TEST(Lattice, OfAFormationIsWhole) {
  const Results results = results_of({nine_parked});
  EXPECT_EQ(results.at("separate_groups"), 1.0);
  EXPECT_EQ(results.at("lattice_holes"), 0.0);
  EXPECT_EQ(results.at("lattice_defects"), 0.0);
  EXPECT_EQ(results.at("on_lattice_share"), 1.0);
  EXPECT_EQ(results.at("outside_outline_vehicles"), 0.0);
}

TEST(Lattice, HasAHoleWhereTheVehicleInTheMiddleSitsOutside) {
  std::vector<Eigen::Vector2d> places = square_places(3, 3);
  places[4] = {-300.0, 300.0};
  const Results results = results_of({nine_parked, {at(places)}});
  EXPECT_EQ(results.at("separate_groups"), 1.0);
  EXPECT_EQ(results.at("lattice_holes"), 1.0);
  EXPECT_EQ(results.at("lattice_defects"), 1.0);
  EXPECT_EQ(results.at("on_lattice_share"), 1.0);
  EXPECT_EQ(results.at("outside_outline_vehicles"), 1.0);
}

TEST(Lattice, FallsIntoGroupsFartherApartThanOneAndAHalfSeparations) {
  std::vector<Eigen::Vector2d> places = square_places(3, 3);
  for (std::size_t i = 6; i < 9; ++i) places[i].y() += 151.0;
  EXPECT_EQ(results_of({nine_parked, {at(places)}}).at("separate_groups"), 2.0);
  EXPECT_EQ(results_of({nine_parked, {"quality.every_s=0"}}).at("separate_groups"), std::nullopt);
}

TEST(SlotKeeping, OfASwarmThatKeepsItsPlacesSeesNoWave) {
  const Results results = results_of({nine_parked, {"trial.duration_s=1800"}});
  EXPECT_NEAR(*results.at("quality_wave_m"), 0.0, 1e-3);
  EXPECT_EQ(results.at("slot_changes"), 0.0);
  EXPECT_EQ(results.at("quality_in_transit_m"), std::nullopt);
  EXPECT_NEAR(*results.at("quality_in_place_m"), 0.0, 1e-9);
}

TEST(SlotKeeping, SeesTheWorseQualityWhileAVehicleChangesItsSlot) {
  // The corner of a lattice drifts along its side, from one slot to the next one outside.
  const Results results =
      results_of({nine_parked,
                  {"trial.duration_s=6000", "current.kind=channels", "swarm.start.kind=points",
                   "current.channels={speed_m_s=0.1,half_width_m=760}",
                   "quality={every_s=30,layers=2,alignment=\"centroid\"}",
                   at({{0, 100},
                       {300, 100},
                       {600, 100},
                       {0, 400},
                       {300, 400},
                       {600, 400},
                       {0, 700},
                       {300, 700},
                       {600, 1000}})}});
  EXPECT_EQ(results.at("slot_changes"), 1.0);
  EXPECT_GT(*results.at("quality_in_transit_m"), *results.at("quality_in_place_m") + 5.0);
}

TEST(EnergyLinearity, IsTheGreatestDeviationFromTheLine) {
  const std::vector<double> time = {0, 1, 2, 3};
  EXPECT_NEAR(*nonlinearity(time, std::vector<double>{0, 2, 4, 6}), 0.0, 1e-12);
  // The line through 0, 0, 0, 10 is -2 + 3 t: off by 2, 1, 4 and 3.
  EXPECT_NEAR(*nonlinearity(time, std::vector<double>{0, 0, 0, 10}), 0.4, 1e-12);
  EXPECT_EQ(nonlinearity(time, std::vector<double>{1, 1, 1, 0}), std::nullopt);
  EXPECT_EQ(nonlinearity(std::vector<double>{0, 1}, std::vector<double>{0, 1}), std::nullopt);
  EXPECT_NEAR(*results_of({nine_parked, {"energy.ping_j=0"}}).at("energy_nonlinearity"), 0.0, 1e-9);
}

TEST(LossPower, OfVehiclesThatDoNotMindIsOne) {
  const Results results =
      results_of({nine_parked, {"energy.ping_j=0", "faults.node_loss={every_s=100,count=3}"}});
  EXPECT_NEAR(*results.at("loss_power_ratio"), 1.0, 1e-9);
  EXPECT_EQ(results_of({nine_parked}).at("loss_power_ratio"), std::nullopt);
}

TEST(LossPower, CountsWhatIsSpentAfterALossAgainstBefore) {
  // Pings of 60 J at 300, 360 ... s: that at the loss falls into the 300 s before, five after.
  const Results results =
      results_of({nine_parked,
                  {"trial.duration_s=700", "ping={period_s=60,first_s=300}",
                   "energy={hotel_w=1,ping_j=60}", "faults.node_loss={every_s=300,count=1}"}});
  EXPECT_NEAR(*results.at("loss_power_ratio"), (300.0 + 5 * 60.0) / (300.0 + 60.0), 1e-9);
}

TEST(ThrustCourse, IsThatOfTheSeries) {
  Setting root;
  for (const char* setting : {"trial.duration_s=1800", "plan.square={rows=3,columns=3}"}) {
    scenarios::apply_set(root, setting);
  }
  const Results results = run_trial(scenarios::read_scenario(root), {.record = false}).results;
  const auto& time = results.earlier_series("thrust_time_ratio_mean");
  const auto& distance = results.earlier_series("thrust_distance_ratio_mean");
  EXPECT_EQ(results.at("thrust_time_ratio_peak"), std::ranges::max(time.values));
  EXPECT_EQ(results.at("thrust_distance_ratio_peak"), std::ranges::max(distance.values));
  const auto top = std::ranges::max_element(time.values) - time.values.begin();
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < distance.values.size(); ++k) {
    const auto same = std::ranges::find(time.time_s, distance.time_s[k]) - time.time_s.begin();
    if (same < top) continue;
    sum += distance.values[k] - time.values[static_cast<std::size_t>(same)];
    ++count;
  }
  EXPECT_NEAR(*results.at("thrust_ratio_gap"), sum / count, 1e-12);
}

TEST(LeastThrust, IsWhereTheVehicleIsThatThrustsLeast) {
  // Nine vehicles in their places but for the corners, which are 100 m too far out.
  std::vector<Eigen::Vector2d> places = square_places(3, 3);
  for (const std::size_t i : {0U, 2U, 6U, 8U})
    places[i] += (places[i] - places[4]).normalized() * 100.0;
  const Results results = results_of({nine_parked,
                                      exact,
                                      {"guidance.drift.drifting_radius_m=20", "trial.duration_s=90",
                                       at(places), "behaviour.kind=rigid_registration"}});
  EXPECT_LT(*results.at("least_thrust_radius"), 0.75);
  EXPECT_EQ(results_of({nine_parked}).at("least_thrust_radius"), std::nullopt);
}

TEST(Spacing, OfALatticeIsItsSeparationEverywhere) {
  const Results results = results_of({nine_parked});
  EXPECT_NEAR(*results.at("spacing_m"), 300.0, 1e-9);
  EXPECT_NEAR(*results.at("spacing_outer_over_inner"), 1.0, 1e-12);
}

TEST(Spacing, IsWiderAtTheEdgeWhereVehiclesSitWiderThere) {
  // On a line: gaps of 200 m in the middle, of 400 m at the ends.
  const Results results =
      results_of({nine_parked,
                  {"plan.square={rows=1,columns=6,separation_m=300}",
                   at({{0, 0}, {400, 0}, {600, 0}, {800, 0}, {1000, 0}, {1400, 0}})}});
  // Outermost three: (500, 500, 300); the others: (300, 200, 200).
  EXPECT_GT(*results.at("spacing_outer_over_inner"), 1.5);
}

TEST(Target, OfTwoNeighboursIsThatOfFigure3_7) {
  const Results results = results_of(
      {nine_parked,
       exact,
       {"trial.duration_s=60", "plan.square={rows=1,columns=3}",
        "behaviour.kind=attraction_repulsion", "behaviour.attraction_repulsion.cohesion.kind=none",
        at({{0, 0}, {-280, -81}, {-25, -193}})}});
  EXPECT_NEAR(*results.at("target_x_m"), -45.0, 1.0);
  EXPECT_NEAR(*results.at("target_y_m"), 106.0, 1.0);
}

TEST(SearchSize, CountsSeedsRotationsAndDistances) {
  const Results results =
      results_of({nine_parked,
                  exact,
                  {"trial.duration_s=60", "behaviour.kind=assignment_registration",
                   "behaviour.assignment_registration.matching.sampled.delta_theta_deg=45"}});
  EXPECT_EQ(results.at("search_assignments"), 9.0 * 8.0);
  EXPECT_EQ(results.at("search_distances"), 9.0 * 8.0 * 9.0 * 9.0);  // the middle one hears all
  EXPECT_EQ(results_of({nine_parked}).at("search_assignments"), std::nullopt);
}

TEST(NeighbourEstimates, OfVehiclesAtRestAreBetterThanSingleMeasurements) {
  const Results results = results_of({nine_parked, {"ping.elevation_sd_deg=0"}});
  EXPECT_LT(*results.at("neighbour_noise_ratio"), 0.75);
  EXPECT_GT(*results.at("neighbour_noise_ratio"), 0.4);
  EXPECT_EQ(results.at("neighbour_lag_m"), std::nullopt);
}

TEST(NeighbourEstimates, AreBehindByTheMeanAgeOfWhatTheFilterRemembers) {
  // Of pings 0, 30, 60 and 90 s old, with weights 1, 3/4, 1/2 and 1/4 (Rypkema 2015, Alg. 3).
  const double mean_age_s = (0.75 * 30.0 + 0.5 * 60.0 + 0.25 * 90.0) / 2.5;
  const double speed_m_s = 0.4;
  const Results results =
      results_of({nine_parked,
                  exact,
                  {"trial.duration_s=900", "plan.square={rows=1,columns=2}", "ping.range_m=5000",
                   "current.kind=channels", "current.channels={speed_m_s=0.4,half_width_m=0.5}",
                   at({{0.0, 0.0}, {3000.0, 1.0}})}});
  EXPECT_NEAR(*results.at("neighbour_lag_m"), speed_m_s * mean_age_s, 1.5);
  EXPECT_EQ(results.at("neighbour_noise_ratio"), std::nullopt);
}

}  // namespace
}  // namespace shoal::analysis
