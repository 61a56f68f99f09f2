// The vehicle in six degrees of freedom: its derivative, one step, its controllers, and the two
// simulations of Barisic et al. 2011 as a whole.

#include <benchmark/benchmark.h>

#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/vehicles/nps_auv/controllers.hpp"
#include "shoal/scenarios/world.hpp"
#include "tests/bench/cruising.hpp"

namespace {

using namespace shoal::scenarios;
using shoal::bench::cruising;

void nps_auv_derivative(benchmark::State& state) {
  const NpsAuvModel model;
  VehicleState x = cruising();
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(model.derivative(x, {.rudder_rad = 0.1, .propeller_rad_s = 50.0}));
  }
}
BENCHMARK(nps_auv_derivative);

void nps_auv_rk4_step(benchmark::State& state) {
  const NpsAuvModel model;
  VehicleState x = cruising();
  for (auto _ : state) {
    x = model.integrate(x, {.rudder_rad = 0.01, .propeller_rad_s = 50.0}, 0.05);
    benchmark::DoNotOptimize(x);
  }
}
BENCHMARK(nps_auv_rk4_step);

void nps_auv_controllers(benchmark::State& state) {
  const NpsAuvControllers controllers;
  VehicleState x = cruising();
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(controllers(x, {.speed_m_s = 1.5, .heading_rad = 0.1}));
  }
}
BENCHMARK(nps_auv_controllers);

/// With noise and filters, one thread; `times_real_time` is how much faster than the sea it runs.
void simulation(benchmark::State& state, const char* name) {
  const Scenario scenario = read_scenario(read_toml(find_scenario(name)));
  for (auto _ : state) {
    World world(scenario);
    world.run({});
    benchmark::DoNotOptimize(world.time_s());
  }
  state.counters["times_real_time"] =
      benchmark::Counter(scenario.trial.duration_s, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(simulation, channel, "potentials_channel")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulation, clutter, "potentials_clutter")->Unit(benchmark::kMillisecond);

}  // namespace
