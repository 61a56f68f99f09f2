#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

Trial brief_trial() {
  Setting root;
  for (const char* setting : {"trial.duration_s=60", "plan.square={rows=2,columns=2}"}) {
    scenarios::apply_set(root, setting);
  }
  return run_trial(scenarios::read_scenario(root), {.record = false});
}

std::vector<std::string> names(const std::vector<Quantity>& quantities) {
  std::vector<std::string> all;
  for (const Quantity& quantity : quantities) all.push_back(quantity.name);
  return all;
}

TEST(KnownQuantities, AreWhatEveryTrialYields) {
  const Results results = brief_trial().results;
  std::vector<std::string> values, series;
  for (const auto& [name, value] : results.values) values.push_back(name);
  for (const scenarios::Series& each : results.series) series.push_back(each.name);
  EXPECT_EQ(values, names(known_values()));
  EXPECT_EQ(series, names(known_series()));
  for (const scenarios::Series& each : results.series) {
    EXPECT_EQ(each.unit, known_series(each.name).unit);
    EXPECT_EQ(each.meaning, known_series(each.name).meaning);
  }
}

TEST(KnownQuantities, HaveNamesOfTheirOwn) {
  for (const auto* known : {&known_values(), &known_series()}) {
    const std::vector<std::string> all = names(*known);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  }
}

TEST(KnownQuantities, EndWithTheirUnit) {
  const std::map<std::string, std::string> endings = {
      {"m", "_m"},     {"s", "_s"}, {"deg", "_deg"},     {"Wh", "_wh"},        {"W", "_w"},
      {"m/s", "_m_s"}, {"h", "_h"}, {"m/h", "_m_per_h"}, {"m/Wh", "_m_per_wh"}};
  for (const auto* known : {&known_values(), &known_series()}) {
    for (const Quantity& each : *known) {
      const auto& [name, unit] = std::tie(each.name, each.unit);
      EXPECT_FALSE(each.meaning.empty()) << name;
      if (name == "quality") continue;  // as run.nc has called it from the first
      if (unit.empty()) {
        for (const auto& [other, ending] : endings) EXPECT_FALSE(name.ends_with(ending)) << name;
      } else {
        EXPECT_TRUE(name.ends_with(endings.at(unit))) << name << " in " << unit;
      }
    }
  }
}

TEST(KnownQuantities, ThatWaitForAnEventNameItsTimeOrTheirWatch) {
  int events = 0;
  for (const Quantity& each : known_values()) {
    if (!each.censored_by.empty()) {
      EXPECT_EQ(known_value(each.censored_by).unit, each.unit) << each.name;
      ++events;
    }
    if (each.event.empty()) continue;
    EXPECT_FALSE(known_value(each.event).censored_by.empty()) << each.name;
  }
  EXPECT_GE(events, 3);
}

TEST(KnownQuantities, RefuseAnUnknownNameWithTheLikelyOne) {
  const Origin origin{"study.toml", 12};
  const auto message = [&](auto ask) -> std::string {
    try {
      ask();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] { known_value("energy_maen_wh", origin); }),
            "study.toml:12: no measure yields a value \"energy_maen_wh\"; did you mean "
            "\"energy_mean_wh\"?");
  EXPECT_EQ(message([&] { known_series("qualty", origin); }),
            "study.toml:12: no measure yields a series \"qualty\"; did you mean \"quality\"?");
  EXPECT_EQ(known_value("energy_rate_w").unit, "W");
}

/// A measure that declares one value and one series, and adds what it is given.
class Given final : public Measure {
 public:
  std::vector<std::pair<std::string, std::optional<double>>> values_to_add;
  std::vector<scenarios::Series> series_to_add;

  std::vector<Quantity> values() const override { return {{"a_m", "m", "a length"}}; }
  std::vector<Quantity> series() const override { return {{"b_s", "s", "a duration"}}; }
  void finish(const scenarios::World&, Results& results) const override {
    for (const auto& [name, value] : values_to_add) results.add(name, value);
    for (const scenarios::Series& s : series_to_add) {
      results.add_series(s.name, s.time_s, s.values);
    }
  }
};

class Conclude : public testing::Test {
 protected:
  void conclude() { analysis::conclude(given_, *trial_.world, results_); }

  const Trial trial_ = brief_trial();
  Results results_;
  Given given_;

  void SetUp() override {
    given_.values_to_add = {{"a_m", 1.0}};
    given_.series_to_add = {{"b_s", "", "", {0.0, 30.0}, {1.0, 2.0}}};
  }
};

TEST_F(Conclude, AddsUnitAndMeaningOfASeries) {
  conclude();
  ASSERT_EQ(results_.series.size(), 1u);
  EXPECT_EQ(results_.series[0].unit, "s");
  EXPECT_EQ(results_.series[0].meaning, "a duration");
  EXPECT_EQ(results_.at("a_m"), 1.0);
}

TEST_F(Conclude, RefusesWhatWasNotDeclared) {
  given_.values_to_add = {{"c_m", 1.0}};
  EXPECT_THROW(conclude(), std::logic_error);
  given_.values_to_add = {{"a_m", 1.0}, {"c_m", 1.0}};
  EXPECT_THROW(conclude(), std::logic_error);
}

TEST_F(Conclude, RefusesASeriesThatWasNotDeclared) {
  given_.series_to_add[0].name = "a_m";
  EXPECT_THROW(conclude(), std::logic_error);
}

TEST_F(Conclude, AsksForAllThatWasDeclared) {
  given_.values_to_add.clear();
  EXPECT_THROW(conclude(), std::logic_error);
}

TEST_F(Conclude, AsksForEverySeriesThatWasDeclared) {
  given_.series_to_add.clear();
  EXPECT_THROW(conclude(), std::logic_error);
}

TEST_F(Conclude, TakesAValueThatIsNotDefined) {
  given_.values_to_add = {{"a_m", std::nullopt}};
  conclude();
  EXPECT_EQ(results_.at("a_m"), std::nullopt);
}

TEST_F(Conclude, RefusesWhatIsNotFinite) {
  given_.values_to_add = {{"a_m", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_THROW(conclude(), std::logic_error);
}

TEST_F(Conclude, RefusesASeriesWithoutANumberAtEveryInstant) {
  given_.series_to_add[0].values = {1.0};
  EXPECT_THROW(conclude(), std::logic_error);
  given_.series_to_add[0].values = {1.0, std::numeric_limits<double>::infinity()};
  EXPECT_THROW(conclude(), std::logic_error);
}

}  // namespace
}  // namespace shoal::analysis
