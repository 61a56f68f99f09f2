// Pair potentials: each alone, and what a formula costs beside the same law in C++.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "shoal/formations/potential.hpp"

namespace {

using namespace shoal::formations;

constexpr double s = 300.0;

std::unique_ptr<Potential> potential(const std::string& kind) {
  auto made = shoal::Registry<Potential>::instance().make(kind, shoal::Setting{}, kind);
  made->prepare(s);  // as behaviours do
  return made;
}

constexpr int distances = 64;
double distance(int i) {
  return 200.0 + 5.0 * (i % distances);
}

void derivatives(benchmark::State& state, const std::string& kind) {
  const auto law = potential(kind);
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(law->derivatives(distance(i++), s));
}

const bool registered = [] {
  for (const std::string& kind : shoal::Registry<Potential>::instance().names()) {
    const std::string name = "potential/" + kind;
    benchmark::RegisterBenchmark(name.c_str(),
                                 [kind](benchmark::State& state) { derivatives(state, kind); });
  }
  return true;
}();

template <class Evaluate>
double seconds(const Evaluate& evaluate) {
  constexpr int rounds = 2000;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < rounds * distances; ++k) evaluate(distance(k));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Eq. 3.3 as a formula over eq. 3.3 in C++, in turns: the least time of each counts, so that the
/// machine's other work does not.
void formula_over_cpp(benchmark::State& state) {
  const auto cpp = potential("thesis");
  const auto formula = potential("expression");
  std::array<double, 4> least;
  least.fill(1e300);
  const auto time = [&](int k, const auto& evaluate) {
    auto& best = least[static_cast<std::size_t>(k)];
    best = std::min(best, seconds(evaluate));
  };
  for (auto _ : state) {
    time(0, [&](double r) { benchmark::DoNotOptimize(cpp->derivatives(r, s)); });
    time(1, [&](double r) { benchmark::DoNotOptimize(formula->derivatives(r, s)); });
    time(2, [&](double r) { benchmark::DoNotOptimize(cpp->value(r, s)); });
    time(3, [&](double r) { benchmark::DoNotOptimize(formula->value(r, s)); });
  }
  state.counters["derivatives_ratio"] = least[1] / least[0];
  state.counters["value_ratio"] = least[3] / least[2];
}
BENCHMARK(formula_over_cpp)->Unit(benchmark::kMillisecond);

}  // namespace
