#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis::test {

using Settings = std::vector<std::string>;

/// Four vehicles on a square of 300 m that never thrust: they are where their radius says.
inline const Settings parked = {"trial.duration_s=100",
                                "plan.square={rows=2,columns=2,separation_m=300}",
                                "swarm.start.kind=plan", "guidance.drift.drifting_radius_m=100000",
                                "quality={every_s=10,layers=0}"};

inline scenarios::Scenario scenario_of(const Settings& base, const Settings& more) {
  Setting root;
  for (const std::string& setting : base) scenarios::apply_set(root, setting);
  for (const std::string& setting : more) scenarios::apply_set(root, setting);
  return scenarios::read_scenario(root);
}

inline Trial run(const Settings& base, const Settings& more = {}) {
  return run_trial(scenario_of(base, more), {.record = false});
}

inline const scenarios::Series& series(const Results& results, const std::string& name) {
  return *std::ranges::find(results.series, name, &scenarios::Series::name);
}

}  // namespace shoal::analysis::test
