// One filter cycle of one vehicle (predict and correct, 14 states, 12 measurements), and its parts.

#include <benchmark/benchmark.h>

#include "shoal/scenarios/estimators/vehicle_filter.hpp"
#include "tests/bench/cruising.hpp"

namespace {

using namespace shoal::scenarios;
using shoal::bench::cruising;
constexpr double period_s = 0.5;

template <class Process>
void cycle(benchmark::State& state, const Process& process) {
  VehicleState x = cruising();
  const VehicleFilterOptions options;
  VehicleFilter filter(options, options.settings({}, period_s), x, period_s);
  const KinematicModel moves{period_s};
  for (auto _ : state) {
    x = moves(x);
    filter.predict(process);
    benchmark::DoNotOptimize(filter.correct(x, x, Eigen::Vector2d::Zero()).nees);
  }
}

void ukf_cycle_without_model(benchmark::State& state) {
  cycle(state, [](const VehicleBelief& x) { return x; });
}
BENCHMARK(ukf_cycle_without_model);

void ukf_cycle_kinematic(benchmark::State& state) {
  cycle(state, KinematicModel{period_s});
}
BENCHMARK(ukf_cycle_kinematic);

void kinematic_model_29_points(benchmark::State& state) {
  VehicleState x = cruising();
  for (auto _ : state) {
    for (int k = 0; k < 29; ++k) benchmark::DoNotOptimize(x = KinematicModel{period_s}(x));
  }
}
BENCHMARK(kinematic_model_29_points);

void sensor_sample(benchmark::State& state) {
  SensorBanks banks({}, 1, shoal::RandomStreams(1), period_s);
  std::uint64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(banks.sample(0, k++));
}
BENCHMARK(sensor_sample);

/// As cheap as a vehicle's own model can be.
struct Motionless {
  VehicleState operator()(const VehicleState& x, const Eigen::Vector2d&) const { return x; }
  BodyTangent tangent(const VehicleState&) const { return BodyTangent::Zero(); }
};

void estimator_sample(benchmark::State& state) {
  const auto how = shoal::Registry<Estimator>::instance().make("ukf", {}, "estimator.ukf");
  VehicleState x = cruising();
  const auto navigation = how->launch({x}, {}, shoal::RandomStreams(1), period_s);
  const Motionless moves;
  std::uint64_t k = 0;
  for (auto _ : state) {
    if (k > 0) x = KinematicModel{period_s}(x);
    benchmark::DoNotOptimize(navigation->sample(0, k++, x, Eigen::Vector2d::Zero(), moves).nees);
  }
}
BENCHMARK(estimator_sample);

void estimator_launch(benchmark::State& state) {
  const auto how = shoal::Registry<Estimator>::instance().make("ukf", {}, "estimator.ukf");
  for (auto _ : state) {
    benchmark::DoNotOptimize(how->launch({cruising()}, {}, shoal::RandomStreams(1), period_s));
  }
}
BENCHMARK(estimator_launch)->Unit(benchmark::kMillisecond);

}  // namespace
