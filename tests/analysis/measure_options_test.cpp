// Options of measures stand under their names in a scenario.

#include <gtest/gtest.h>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal::analysis {
namespace {

using scenarios::Scenario;
using tests::complaint_of;

Scenario measured_scenario(const std::vector<std::string>& sets) {
  Setting root = scenarios::read_toml(scenarios::find_scenario("construction_square"));
  scenarios::apply_set(root, "trial.duration_s=300");
  for (const std::string& set : sets) scenarios::apply_set(root, set);
  return scenarios::read_scenario(root);
}

Trial measured_trial(const std::vector<std::string>& sets) {
  return run_trial(measured_scenario(sets), {.record = false});
}

TEST(MeasureOptions, ChangeTheirMeasureAndNoOther) {
  const Trial trial = measured_trial({});
  const Results& usual = trial.results;
  const Results apart = measured_trial({"measure.lattice.together_spacings=1e-6"}).results;
  const auto vehicles = static_cast<double>(trial.world->size());
  EXPECT_EQ(apart.at("separate_groups"), vehicles) << "each is a group of its own";
  EXPECT_LT(usual.at("separate_groups"), vehicles);
  for (const auto& [name, value] : usual.values) {
    if (name == "separate_groups" || name == "lattice_defects") continue;
    EXPECT_EQ(apart.at(name), value) << name;
  }
}

TEST(MeasureOptions, StandInTheResolvedScenarioWhereOneWasGiven) {
  EXPECT_EQ(scenarios::resolved_scenario(measured_scenario({})).find("measure"), nullptr);
  const Setting written =
      scenarios::resolved_scenario(measured_scenario({"measure.lattice.on_point_spacings=0.3"}));
  ASSERT_NE(written.find_path("measure.lattice.on_point_spacings"), nullptr);
  EXPECT_EQ(std::get<double>(written.find_path("measure.lattice.on_point_spacings")->value), 0.3);
  EXPECT_EQ(std::get<double>(written.find_path("measure.lattice.together_spacings")->value), 1.5)
      << "the others of that measure, too";
  EXPECT_EQ(written.find("measure")->table().size(), 1u);
  const Setting again = scenarios::resolved_scenario(scenarios::read_scenario(written));
  EXPECT_EQ(to_toml(again), to_toml(written));
}

TEST(MeasureOptions, AreCheckedBeforeTheRun) {
  const auto says = [](const std::string& set, const std::string& words) {
    const std::string said = complaint_of([&] { measured_scenario({set}); });
    EXPECT_TRUE(said.ends_with(": " + words)) << said;
  };
  says("measure.latice.on_point_spacings=0.3",
       "measure has no option \"latice\"; did you mean \"lattice\"?");
  says("measure.lattice.on_point_spacing=0.3",
       "measure.lattice has no option \"on_point_spacing\"; did you mean \"on_point_spacings\"?");
  says("measure.lattice.on_point_spacings=0",
       "measure.lattice.on_point_spacings is 0; it takes above 0");
  says("measure.slot_keeping.arrived_spacings=2",
       "measure.slot_keeping: arrived_spacings must be below left_spacings");
  says("measure=1", "measure is an integer; it takes a table with a table for each member");
  EXPECT_NE(complaint_of([] { measured_scenario({"measure.kind=\"lattice\""}); }), "");
}

TEST(MeasureOptions, HaveKeysAsAnyOption) {
  const OptionPlace place =
      locate(schema_of<Scenario>(), "measure.neighbour_estimates.moving_m_s", {});
  EXPECT_EQ(place.option->unit, "m/s");
  EXPECT_EQ(place.key, "measure.neighbour_estimates.moving_m_s");
  EXPECT_EQ(std::get<double>(place.fallback->value), 0.3);
  EXPECT_EQ(complaint_of([] {
              locate(schema_of<Scenario>(), "measure.kind", {});
            }).find("measure: there is no measure \"kind\""),
            0u);
}

}  // namespace
}  // namespace shoal::analysis
