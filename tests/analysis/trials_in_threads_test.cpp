#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::analysis {
namespace {

/// Trials that between them use every library with state of its own, and all that is kept from call
/// to call of a thread.
std::vector<scenarios::Scenario> mixed_scenarios() {
  const std::string solver = "behaviour.attraction_repulsion.solver.kind=";
  const std::string ar = "behaviour.kind=attraction_repulsion";
  const std::vector<std::vector<std::string>> wanted = {
      {"redsea_square", "behaviour.kind=rigid_registration"},
      {"redsea_square", "behaviour.kind=assignment_registration"},
      {"redsea_hexagonal", "behaviour.kind=pairwise_referencing"},
      {"redsea_square", ar, "behaviour.attraction_repulsion.potential.kind=expression"},
      {"construction_hexagonal", ar, "behaviour.attraction_repulsion.potential.kind=expression",
       "behaviour.attraction_repulsion.potential.expression.formula=exp(-r/s)+r/s",
       "behaviour.attraction_repulsion.selection.kind=delaunay"},
      {"construction_hexagonal", ar, solver + "nlopt.lbfgs"},
      {"construction_hexagonal", ar, solver + "nlopt.praxis"},
      {"construction_hexagonal", ar, solver + "ceres.lbfgs"},
      {"construction_square", "behaviour.kind=rigid_registration",
       "behaviour.rigid_registration.loss.kind=huber",
       "behaviour.rigid_registration.registration.kind=ceres"},
      {"construction_square", "behaviour.kind=assignment_registration",
       "faults.node_loss={every_s=30,count=3}"},
      {"maintenance_channels_hexagonal", "behaviour.kind=assignment_registration",
       "plan.hexagonal.columns=4"},
      {"maintenance_vortex_square", "behaviour.kind=pairwise_referencing"},
      {"letters_nr", "behaviour.kind=assignment_registration"},
  };
  std::vector<scenarios::Scenario> made;
  for (const std::vector<std::string>& each : wanted) {
    Setting root = scenarios::read_toml(scenarios::find_scenario(each[0]));
    for (std::size_t i = 1; i < each.size(); ++i) scenarios::apply_set(root, each[i]);
    scenarios::apply_set(root, "trial.duration_s=120");
    made.push_back(scenarios::read_scenario(root));
  }
  return made;
}

bool same_bits(const Results& a, const Results& b) {
  return a.values == b.values &&
         std::ranges::equal(a.series, b.series, [](const auto& one, const auto& other) {
           return one.name == other.name && one.time_s == other.time_s &&
                  one.values == other.values;
         });
}

TEST(TrialsInThreads, GiveTheBitsOfTrialsOneAfterAnother) {
  solvers::silence_backends();
  const std::vector<scenarios::Scenario> scenarios = mixed_scenarios();
  std::vector<Results> alone;
  for (const scenarios::Scenario& scenario : scenarios) {
    alone.push_back(run_trial(scenario, {.record = false}).results);
  }
  // Twice each, in an order that brings the same scenario into different company.
  const std::size_t trials = 2 * scenarios.size();
  const auto scenario_of = [&](std::size_t trial) { return trial * 5 % scenarios.size(); };
  std::vector<Results> together(trials);
  std::atomic<std::size_t> next = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (std::size_t trial = next++; trial < trials; trial = next++) {
          together[trial] = run_trial(scenarios[scenario_of(trial)], {.record = false}).results;
        }
      });
    }
  }
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const std::size_t i = scenario_of(trial);
    EXPECT_TRUE(same_bits(together[trial], alone[i])) << "scenario " << i;
  }
}

}  // namespace
}  // namespace shoal::analysis
