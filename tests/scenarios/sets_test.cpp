#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "shoal/core/registry.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::scenarios {
namespace {

using Keys = std::set<std::string>;

std::string below(const std::string& path, const std::string& name) {
  return path.empty() ? name : path + "." + name;
}

void collect(const Setting& setting, const std::string& path, Keys& keys) {
  if (!setting.is_table()) {
    keys.insert(path);
    return;
  }
  for (const auto& [name, entry] : setting.table()) collect(entry, below(path, name), keys);
}

/// The options that a set names itself.
Keys named_in(const std::string& set) {
  Keys keys;
  collect(read_toml(set_file(set)), "", keys);
  keys.erase(inherits_key);
  return keys;
}

/// Every option of a struct, below choices of the kind that stands in `written`.
void declared(const Schema& schema, const Setting& written, const std::string& path, Keys& keys) {
  for (const Option& option : schema.options) {
    const std::string key = below(path, option.name);
    if (option.table) {
      declared(*option.table, written, key, keys);
    } else if (option.choice) {
      keys.insert(key + ".kind");
      const Setting* kind = written.find_path(key + ".kind");
      ASSERT_NE(kind, nullptr) << key;
      const auto& name = std::get<std::string>(kind->value);
      declared(option.choice->find(name)->schema(), written, below(key, name), keys);
    } else {
      keys.insert(key);
    }
  }
}

/// Whether an option says which experiment is run, not how the thesis' vehicles work.
bool makes_the_scenario(const std::string& key) {
  static const Keys names{"trial.duration_s", "trial.seed",       "trial.record_every_s",
                          "trial.start",      "swarm.start.kind", "swarm.start.box.side_m",
                          "trial.time_solves"};
  return names.contains(key);
}

constexpr const char* behaviours[] = {"attraction_repulsion", "pairwise_referencing",
                                      "rigid_registration", "assignment_registration"};

/// The options of the tables that the sets are about, as chosen by one of them.
Keys options_involved(const std::string& set) {
  TomlFiles files;
  const Setting written = with_inherited(read_toml(set_file(set)), files).settings;
  Keys keys;
  for (const Option& option : schema_of<Scenario>().options) {
    if (option.table && option.name != "waypoint" && option.name != "swarm") {
      declared(*option.table, written, option.name, keys);
    }
  }
  keys.insert("guidance.kind");
  declared(Registry<formations::Guidance>::instance().find("drift")->schema(), written,
           "guidance.drift", keys);
  keys.insert("swarm.vehicle.kind");
  declared(Registry<VehicleType>::instance().find("drifter")->schema(), written,
           "swarm.vehicle.drifter", keys);
  for (const char* start : {"box", "plan"}) {
    declared(Registry<StartSource>::instance().find(start)->schema(), written,
             std::string("swarm.start.") + start, keys);
  }
  for (const std::string behaviour : behaviours) {
    declared(Registry<formations::Behaviour>::instance().find(behaviour)->schema(), written,
             "behaviour." + behaviour, keys);
  }
  std::erase_if(keys, makes_the_scenario);
  return keys;
}

std::string listed_difference(const Keys& a, const Keys& b) {
  std::string text;
  for (const std::string& key : a) {
    if (!b.contains(key)) text += key + "\n";
  }
  return text;
}

TEST(Sets, TextAndProgramNameTheSameOptions) {
  EXPECT_EQ(listed_difference(named_in("text"), named_in("program")), "") << "only in text";
  EXPECT_EQ(listed_difference(named_in("program"), named_in("text")), "") << "only in program";
}

TEST(Sets, EveryOptionIsInTheSetsOrAmongOursAndInOneOfThem) {
  const Keys ours = named_in("ours");
  for (const std::string set : {"text", "program"}) {
    Keys named = named_in(set);
    for (const std::string& key : ours) EXPECT_FALSE(named.contains(key)) << key;
    named.insert(ours.begin(), ours.end());
    const Keys involved = options_involved(set);
    EXPECT_EQ(listed_difference(involved, named), "") << "left to defaults by " << set;
    EXPECT_EQ(listed_difference(named, involved), "") << "no option, or not one of these tables";
  }
}

TEST(Sets, EveryValueHasItsSourceBesideIt) {
  for (const std::string set : {"text", "program"}) {
    std::ifstream in(set_file(set));
    int values = 0;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with('#') || line.find(" = ") == std::string::npos) continue;
      if (line.starts_with(inherits_key)) continue;
      ++values;
      EXPECT_NE(line.find("  # "), std::string::npos) << line;
    }
    EXPECT_EQ(static_cast<std::size_t>(values), named_in(set).size());
    EXPECT_NE(set_summary(set), "");
  }
}

TEST(Sets, ScenariosOfTheThesisHoldOnlyWhatMakesThem) {
  // Where a section says otherwise than the tables of chapter 3.
  const Keys said_by_sections{"behaviour.assignment_registration.matching.sampled.delta_theta_deg",
                              "behaviour.rigid_registration.ownship_weight"};
  const Keys settled = named_in("text");
  int found = 0;
  for (const std::string& name : library_scenarios()) {
    if (name.starts_with("potentials_") || name == "estimation") continue;
    ++found;
    const Setting root = read_toml(library_path() / (name + ".toml"));
    ASSERT_NE(root.find(inherits_key), nullptr) << name;
    Keys own;
    collect(root, "", own);
    for (const std::string& key : own) {
      EXPECT_TRUE(!settled.contains(key) || said_by_sections.contains(key)) << name << ": " << key;
    }
  }
  EXPECT_EQ(found, 10);
}

TEST(Sets, EveryThesisScenarioRunsUnderBoth) {
  for (const std::string name :
       {"construction_square", "maintenance_vortex_hexagonal", "letters_nr", "redsea_hexagonal"}) {
    for (const std::string set : {"text", "program"}) {
      Setting root = read_toml(find_scenario(name));
      apply_set(root, "inherits=" + set);
      const Scenario scenario = read_scenario(root);
      EXPECT_EQ(scenario.planner.update == PlannerOptions::Update::tick, set == "program") << name;
    }
  }
}

TEST(Sets, AsRunIsTheSquareRedSeaUnderTheProgramsSettings) {
  Setting square = read_toml(find_scenario("redsea_square"));
  apply_set(square, "inherits=program");
  apply_set(square, "current.netcdf.outside=clamp");
  apply_set(square, "quality.alignment=nearest_point");
  EXPECT_EQ(
      to_toml(resolved_scenario(read_scenario(square))),
      to_toml(resolved_scenario(read_scenario(read_toml(find_scenario("redsea_square_as_run"))))));
}

}  // namespace
}  // namespace shoal::scenarios
