// Whole trials on one thread, with their measures, without files. One iteration is one trial.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "shoal/analysis/benchmarking/problem_recorder.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace {

using shoal::analysis::run_trial;

shoal::scenarios::Scenario scenario(const std::string& name, const std::vector<std::string>& sets) {
  shoal::Setting root = shoal::scenarios::read_toml(shoal::scenarios::find_scenario(name));
  for (const std::string& set : sets) shoal::scenarios::apply_set(root, set);
  return shoal::scenarios::read_scenario(root);
}

void trial(benchmark::State& state, const std::string& name, const std::vector<std::string>& sets) {
  const auto wanted = scenario(name, sets);
  double vehicle_seconds = 0.0;
  for (auto _ : state) {
    const auto ran = run_trial(wanted, {.threads = 1, .record = false});
    vehicle_seconds += static_cast<double>(ran.world->size()) * ran.world->time_s();
  }
  state.counters["vehicle_s_per_s"] =
      benchmark::Counter(vehicle_seconds, benchmark::Counter::kIsRate);
}

void redsea(benchmark::State& state, const char* behaviour) {
  trial(state, "redsea_square", {std::string("behaviour.kind=") + behaviour});
}
BENCHMARK_CAPTURE(redsea, rigid_registration, "rigid_registration")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(redsea, pairwise_referencing, "pairwise_referencing")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(redsea, attraction_repulsion, "attraction_repulsion")->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(redsea, assignment_registration, "assignment_registration")
    ->Unit(benchmark::kSecond);

void redsea_as_run(benchmark::State& state) {
  trial(state, "redsea_square_as_run", {"behaviour.kind=rigid_registration"});
}
BENCHMARK(redsea_as_run)->Unit(benchmark::kSecond);

// Trials with and without `shoal run --record-problems` in turn: by how many percent the fastest of
// the one kind are slower than the fastest of the other. One iteration is both.
void recorded(benchmark::State& state, const std::string& name,
              const std::vector<std::string>& sets) {
  constexpr std::size_t kept_by_run = 1000;
  const auto wanted = scenario(name, sets);
  double fastest[2] = {std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::infinity()};
  for (auto _ : state) {
    for (const bool record : {false, true}) {
      using Clock = std::chrono::steady_clock;
      const Clock::time_point begin = Clock::now();
      shoal::analysis::ProblemRecorder recorder(kept_by_run);
      shoal::analysis::TrialSettings settings{.threads = 1, .record = false};
      if (record) settings.plan_observer = recorder.of_trial();
      benchmark::DoNotOptimize(run_trial(wanted, settings).results);
      const std::chrono::duration<double> took = Clock::now() - begin;
      fastest[record] = std::min(fastest[record], took.count());
    }
  }
  state.counters["recording_percent"] = 100.0 * (fastest[true] / fastest[false] - 1.0);
}
BENCHMARK_CAPTURE(recorded, redsea, "redsea_square", std::vector<std::string>{})
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(recorded, redsea_without_quality, "redsea_square",
                  std::vector<std::string>{"quality.every_s=0"})
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(recorded, redsea_as_run, "redsea_square_as_run", std::vector<std::string>{})
    ->Unit(benchmark::kSecond);

// A formed lattice of n x n vehicles in a vortex: the cost per vehicle should not depend on n.
void lattice(benchmark::State& state) {
  const std::string side = std::to_string(state.range(0));
  trial(state, "maintenance_vortex_square",
        {"plan.square={rows=" + side + ",columns=" + side + "}", "trial.duration_s=3600",
         "quality.every_s=0", "planner.update=ping"});
}
BENCHMARK(lattice)->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kSecond);

}  // namespace
