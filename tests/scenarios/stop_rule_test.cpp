#include "shoal/scenarios/stops/stop_rule.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"
#include "tests/scenarios/scenario_of.hpp"

namespace shoal::scenarios {
namespace {

using tests::scenario_of;

std::unique_ptr<StopRule> settled(double threshold_m, double window_s, double not_before_s = 0.0) {
  Setting table;
  assign(table, "threshold_m", {threshold_m, {}});
  assign(table, "window_s", {window_s, {}});
  assign(table, "not_before_s", {not_before_s, {}});
  return Registry<StopRule>::instance().make("settled", table, "test");
}

/// When a rule is first met by a quality that is measured every 10 s, or -1.
double met_s(const StopRule& rule, const std::vector<double>& quality_m) {
  std::vector<double> time_s;
  for (std::size_t k = 0; k < quality_m.size(); ++k) {
    time_s.push_back(10.0 * static_cast<double>(k));
    if (rule.met({time_s, std::span(quality_m).first(k + 1)})) return time_s.back();
  }
  return -1.0;
}

TEST(SettledRule, IsMetOnceAllOfAWindowLiesWithinTheThreshold) {
  const std::vector<double> quality{90, 50, 20, 12, 11, 10.5, 10, 10.5, 10};
  EXPECT_EQ(met_s(*settled(2.0, 30.0), quality), 60.0);   // 12 at 30 s to 10 at 60 s
  EXPECT_EQ(met_s(*settled(1.9, 30.0), quality), 70.0);   // without the 12
  EXPECT_EQ(met_s(*settled(10.0, 30.0), quality), 50.0);  // 20 to 10.5
  EXPECT_EQ(met_s(*settled(0.4, 30.0), quality), -1.0);
  EXPECT_EQ(met_s(*settled(1e9, 80.0), quality), 80.0);  // the window must have passed
  EXPECT_EQ(met_s(*settled(1e9, 81.0), quality), -1.0);
}

TEST(SettledRule, IsNotMetByASwingThatReturns) {
  EXPECT_EQ(met_s(*settled(3.0, 20.0), {20, 40, 20, 40, 20, 40, 20}), -1.0);
}

TEST(SettledRule, IsNotMetBeforeItsTime) {
  const std::vector<double> flat(20, 7.0);
  EXPECT_EQ(met_s(*settled(3.0, 20.0), flat), 20.0);
  EXPECT_EQ(met_s(*settled(3.0, 20.0, 100.0), flat), 100.0);
}

TEST(DurationRule, IsNeverMet) {
  const auto rule = Registry<StopRule>::instance().make("duration", Setting{}, "test");
  EXPECT_EQ(met_s(*rule, std::vector<double>(20, 0.0)), -1.0);
}

// In a world --------------------------------------------------------------------------------------

std::string complaint(const std::vector<std::string>& sets) {
  try {
    scenario_of(sets);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Says that the quality is a given function of time.
struct Judge final : Observer {
  std::function<double(double)> of;
  std::vector<double> time_s, quality_m;
  explicit Judge(std::function<double(double)> f) : of(std::move(f)) {}
  double every_s() const override { return 10.0; }
  void observe(const World& world) override {
    time_s.push_back(world.time_s());
    quality_m.push_back(of(world.time_s()));
  }
  std::optional<QualitySoFar> quality() const override { return QualitySoFar{time_s, quality_m}; }
};

struct LastLook final : Observer {
  double interval_s, last_s = -1.0;
  explicit LastLook(double every) : interval_s(every) {}
  double every_s() const override { return interval_s; }
  void observe(const World& world) override { last_s = world.time_s(); }
};

const std::vector<std::string> settling{"plan.square={rows=2,columns=2}", "trial.duration_s=300",
                                        "quality.every_s=10", "stop.kind=settled",
                                        "stop.settled={threshold_m=2,window_s=60}"};

TEST(StopRule, EndsTheWorldAtTheSameInstantHoweverOftenItIsLookedAt) {
  const auto falling = [](double t) { return t < 100.0 ? 100.0 - t : 0.0; };
  std::vector<double> x;
  for (const double every_s : {0.25, 7.0, 10.0, 1000.0}) {
    World world(scenario_of(settling));
    Judge judge(falling);
    LastLook looker(every_s);
    Observer* const observers[] = {&looker, &judge};
    world.run(observers);
    EXPECT_EQ(world.time_s(), 160.0);  // zero from 100 s on
    EXPECT_EQ(world.stopped_by(), "settled");
    if (x.empty()) x = world.swarm().x_m;
    EXPECT_EQ(world.swarm().x_m, x);
    if (every_s <= 10.0 && every_s != 7.0) {
      EXPECT_EQ(looker.last_s, 160.0) << "all look at the end";
    }
  }
}

TEST(StopRule, LeavesAWorldThatNeverSettlesToItsDuration) {
  World world(scenario_of(settling));
  Judge judge([](double t) { return t; });
  Observer* const observers[] = {&judge};
  world.run(observers);
  EXPECT_EQ(world.time_s(), 300.0);
  EXPECT_EQ(world.stopped_by(), "duration");
}

TEST(StopRule, NeedsAnObserverThatMeasuresTheQuality) {
  World world(scenario_of(settling));
  LastLook looker(10.0);
  Observer* const observers[] = {&looker};
  EXPECT_THROW(world.run(observers), InputError);
}

TEST(StopRule, NeedsAQualityThatIsMeasuredOftenEnough) {
  EXPECT_NE(complaint({"stop.kind=settled", "quality.every_s=0"}).find("quality.every_s above 0"),
            std::string::npos);
  EXPECT_NE(complaint({"stop.kind=settled", "quality.every_s=600"})
                .find("stop.settled: window_s is 300 s, shorter than quality.every_s = 600 s"),
            std::string::npos);
  EXPECT_EQ(complaint({"quality.every_s=600"}), "");
}

}  // namespace
}  // namespace shoal::scenarios
