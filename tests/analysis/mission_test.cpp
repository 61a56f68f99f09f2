// The length of missions, and the rules that end them.

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/analysis/parked_trials.hpp"

namespace shoal::analysis {
namespace {

using namespace test;

/// Twelve vehicles that form a lattice of squares; a rule ends the trial.
const Settings twelve_forming = {"trial.duration_s=3000",
                                 "plan.square={rows=3,columns=4,separation_m=300}",
                                 "behaviour.kind=rigid_registration", "quality.every_s=10",
                                 "stop.settled={threshold_m=20,window_s=200}"};

TEST(Mission, EndsWhenTheFormationHasSettled) {
  const Trial whole = run(twelve_forming);
  EXPECT_EQ(whole.results.at("mission_s"), 3000.0);
  EXPECT_EQ(whole.results.at("stopped_s"), std::nullopt);
  EXPECT_EQ(whole.results.at("stop_watched_s"), std::nullopt);

  const Trial stopped = run(twelve_forming, {"stop.kind=settled"});
  const double end_s = *stopped.results.at("mission_s");
  EXPECT_EQ(stopped.results.at("stopped_s"), end_s);
  EXPECT_EQ(stopped.results.at("stop_watched_s"), end_s);
  EXPECT_EQ(stopped.world->stopped_by(), "settled");
  EXPECT_LT(end_s, 3000.0);

  // The first instant at which the rule holds, by its definition, on the trial that went on.
  const scenarios::Series& quality = series(whole.results, "quality");
  double expected_s = -1.0;
  for (std::size_t k = 20; k < quality.values.size() && expected_s < 0.0; ++k) {
    const auto [least, greatest] =
        std::ranges::minmax(std::span(quality.values).subspan(k - 20, 21));
    if (greatest - least <= 20.0) expected_s = quality.time_s[k];
  }
  EXPECT_EQ(end_s, expected_s);
  // Until then the two are one, bit for bit.
  const scenarios::Series& of_stopped = series(stopped.results, "quality");
  ASSERT_LE(of_stopped.values.size(), quality.values.size());
  for (std::size_t k = 0; k < of_stopped.values.size(); ++k) {
    EXPECT_EQ(of_stopped.values[k], quality.values[k]);
  }
  EXPECT_EQ(series(stopped.results, "energy_mean_wh").time_s.back(), end_s);
}

TEST(Mission, ThatNeverSettlesHasNoTimeAtWhichItWasStopped) {
  const Trial tired = run(twelve_forming, {"stop.kind=settled", "stop.settled.threshold_m=1e-9",
                                           "trial.duration_s=600"});
  EXPECT_EQ(tired.results.at("mission_s"), 600.0);
  EXPECT_EQ(tired.results.at("stopped_s"), std::nullopt);
  EXPECT_EQ(tired.results.at("stop_watched_s"), 600.0);
}

TEST(Mission, IsEndedAtTheSameInstantWithAndWithoutARecord) {
  const scenarios::Scenario watched =
      scenario_of(twelve_forming, {"stop.kind=settled", "trial.record_every_s=7"});
  const Trial bare = run_trial(watched, {.record = false});
  const Trial recorded = run_trial(watched, {.threads = 2, .record = true});
  EXPECT_EQ(bare.results.values, recorded.results.values);
}

TEST(Energy, LastsAsLongAsTheAuthorsProgramEstimates) {
  // ESTIMATION_DURATION_DAYS: energy pack x mission time / energy spent. Drifting with a hotel load
  // of 2 W, and 1001 pings of 10 J in 10 000 s: 3.001 W.
  const Results results = run(parked, {"energy={hotel_w=2,ping_j=10,battery_wh=72}",
                                       "ping.period_s=10", "trial.duration_s=10000"})
                              .results;
  EXPECT_NEAR(*results.at("endurance_mean_h"), 72.0 / 3.001, 1e-9);
  EXPECT_NEAR(*results.at("endurance_min_h"), 72.0 / 3.001, 1e-9);
}

TEST(Energy, IsSpentAtTheRateOfTheMissionAsItWasEnded) {
  // At rest from the start: the rule ends the mission when its window has passed.
  const Results results = run(parked, {"trial.duration_s=2000", "stop.kind=settled"}).results;
  EXPECT_EQ(results.at("mission_s"), 300.0);
  EXPECT_NEAR(*results.at("energy_rate_w"), 1.5 + 2.4 / 30.0, 1e-9);  // pings at 150 to 300 s
}

}  // namespace
}  // namespace shoal::analysis
