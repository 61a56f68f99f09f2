#include <benchmark/benchmark.h>

#include <random>

#include "shoal/analysis/experiments/measures/formation_quality.hpp"

namespace shoal::analysis {
namespace {

using Alignment = scenarios::QualityOptions::Alignment;
using Points = std::vector<Eigen::Vector2d>;

constexpr double separation_m = 300.0;
constexpr int samples = 16;

formations::Plan square(int columns, int rows) {
  std::vector<std::string> names;
  Points slots;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      names.push_back(std::to_string(i) + "," + std::to_string(j));
      slots.emplace_back(separation_m * i, -separation_m * j);
    }
  }
  return {names, slots};
}

/// Of a swarm of columns x rows vehicles at instants in a row: formed, with 10 m errors that change
/// little, or spread over a box. Beside it, the recipe of the thesis; gap_m is how far the quality
/// is above its lower bound at most.
void quality(benchmark::State& state, Alignment alignment, double box_m) {
  const auto columns = static_cast<int>(state.range(0)), rows = static_cast<int>(state.range(1));
  std::mt19937 random(1);
  std::normal_distribution<double> error(0.0, 10.0), step(0.0, 1.0);
  std::uniform_real_distribution<double> side(-0.5 * box_m, 0.5 * box_m);
  const formations::Plan plan = square(columns, rows);
  std::vector<Points> instants(1);
  for (const Eigen::Vector2d& slot : plan.slots()) {
    instants[0].push_back(box_m > 0.0 ? Eigen::Vector2d(side(random), side(random))
                                      : slot + Eigen::Vector2d(error(random), error(random)));
  }
  while (instants.size() < samples) {
    Points next = instants.back();
    for (Eigen::Vector2d& p : next) p += Eigen::Vector2d(step(random), step(random));
    instants.push_back(next);
  }
  scenarios::QualityOptions options;
  options.alignment = alignment;
  FormationQuality measure(square(columns + 2, rows + 2), options);
  double gap_m = 0.0;
  std::size_t k = 0;
  for (auto _ : state) {
    const FormationQuality::Value value = measure.of(instants[k++ % samples]);
    if (value.lower_bound_m) gap_m = std::max(gap_m, value.quality_m - *value.lower_bound_m);
    benchmark::DoNotOptimize(value.quality_m);
  }
  state.counters["gap_m"] = gap_m;
}

void swarms(benchmark::internal::Benchmark* b) {
  b->ArgNames({"columns", "rows"})->Args({5, 4})->Args({10, 10})->Args({25, 20});
  b->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(quality, rigid_formed, Alignment::rigid, 0.0)->Apply(swarms);
BENCHMARK_CAPTURE(quality, centroid_formed, Alignment::centroid, 0.0)->Apply(swarms);
BENCHMARK_CAPTURE(quality, rigid_in_a_box, Alignment::rigid, 200.0)->Apply(swarms);
BENCHMARK_CAPTURE(quality, centroid_in_a_box, Alignment::centroid, 200.0)->Apply(swarms);

}  // namespace
}  // namespace shoal::analysis
