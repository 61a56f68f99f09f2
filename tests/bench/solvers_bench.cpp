// Times of the solvers on the problems that a vehicle meets at every ping.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/matching/assignment.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/bench/two_neighbours.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr std::size_t samples = 64;

Points lattice(int columns, int rows) {
  Points slots;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) slots.emplace_back(300.0 * i, -300.0 * j);
  }
  return slots;
}

Points in_a_box(std::size_t count, double side_m, std::mt19937& generator) {
  std::uniform_real_distribution<double> place(-0.5 * side_m, 0.5 * side_m);
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(place(generator), place(generator));
  return points;
}

Points near_to(Points slots, std::mt19937& generator) {
  std::normal_distribution<double> noise(0.0, 20.0);
  for (Vector2d& slot : slots) slot += Vector2d(noise(generator), noise(generator));
  return slots;
}

// What vehicle `own` hears: itself first, then its nearest neighbours, relative to itself.
Points seen_from(std::size_t own, std::size_t neighbours, Points swarm) {
  const Vector2d origin = swarm[own % swarm.size()];
  for (Vector2d& p : swarm) p -= origin;
  std::ranges::sort(swarm, {}, [](const Vector2d& p) { return p.norm(); });
  swarm.resize(neighbours + 1);
  return swarm;
}

Points about(Points points, const Vector2d& centre) {
  for (Vector2d& p : points) p -= centre;
  return points;
}

void procrustes(benchmark::State& state) {
  std::mt19937 generator(1);
  const auto count = static_cast<std::size_t>(state.range(0)) + 1;
  const Points from = in_a_box(count, 1000.0, generator);
  const Points to = near_to(from, generator);
  for (auto _ : state) {
    Procrustes sums;
    for (std::size_t i = 0; i < count; ++i) sums.add(from[i], to[i], i == 0 ? 0.1 : 1.0);
    benchmark::DoNotOptimize(sums.solve());
  }
}
BENCHMARK(procrustes)->ArgName("neighbours")->Arg(10)->Arg(19);

void registration(benchmark::State& state, const char* name, const char* loss_name) {
  std::mt19937 generator(1);
  const Points from = in_a_box(10, 1000.0, generator);
  const Points to = near_to(from, generator);
  std::vector<PointPair> pairs;
  for (std::size_t i = 0; i < from.size(); ++i) pairs.push_back({from[i], to[i]});
  const auto loss = Registry<Loss>::instance().make(loss_name, Setting{}, "loss");
  const auto solver = Registry<RegistrationSolver>::instance().make(name, Setting{}, name);
  int evaluations = 0;
  for (auto _ : state) {
    const RegistrationSolution solution = solver->solve({pairs, loss.get()});
    benchmark::DoNotOptimize(solution.cost);
    evaluations = solution.evaluations;
  }
  state.counters["evaluations"] = evaluations;
}
BENCHMARK_CAPTURE(registration, procrustes, "procrustes", "least_squares");
BENCHMARK_CAPTURE(registration, newton_huber, "newton", "huber")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(registration, newton_tukey, "newton", "tukey")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(registration, ceres_huber, "ceres", "huber")->Unit(benchmark::kMicrosecond);

void assignment(benchmark::State& state, bool near) {
  std::mt19937 generator(1);
  const auto n = static_cast<std::size_t>(state.range(0));
  std::vector<std::vector<double>> matrices;
  for (std::size_t k = 0; k < samples; ++k) {
    const Points slots = near ? lattice(static_cast<int>(n) / 5, 5) : in_a_box(n, 2e3, generator);
    const Points points = near ? near_to(slots, generator) : in_a_box(n, 2e3, generator);
    auto& costs = matrices.emplace_back();
    for (const Vector2d& p : points) {
      for (const Vector2d& slot : slots) costs.push_back((p - slot).norm());
    }
  }
  AssignmentSolver solver;
  std::size_t k = 0;
  for (auto _ : state) {
    solver.solve(matrices[k++ % samples], static_cast<int>(n), static_cast<int>(n));
    benchmark::DoNotOptimize(solver.cost());
  }
}
BENCHMARK_CAPTURE(assignment, random, false)
    ->ArgName("n")
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200);
BENCHMARK_CAPTURE(assignment, near, true)
    ->ArgName("n")
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200);

// The formation quality metric: 20 vehicles on a 4 x 5 lattice with a layer more on two sides.
void rotation_search(benchmark::State& state, bool near) {
  std::mt19937 generator(1);
  const Points padded = lattice(6, 7);
  std::vector<Points> swarms;
  for (std::size_t k = 0; k < samples; ++k) {
    swarms.push_back(near ? about(near_to(lattice(4, 5), generator), {450, -600})
                          : in_a_box(20, 200.0, generator));
  }
  const AlignedSlots slots(padded, near ? Vector2d(450, -600) : Vector2d(750, -900));
  const Turns turns(10.0);
  RotationSearch search;
  std::size_t k = 0;
  for (auto _ : state) {
    search.set_points(swarms[k++ % samples]);
    search.match(turns, slots, search.search(turns, slots).turn);
    benchmark::DoNotOptimize(search.cost());
  }
}
BENCHMARK_CAPTURE(rotation_search, random, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(rotation_search, near, true)->Unit(benchmark::kMicrosecond);

void sampled(benchmark::State& state, bool near, double ownship_weight) {
  std::mt19937 generator(1);
  const Points slots = lattice(4, 5);
  std::vector<Points> seen;
  for (std::size_t k = 0; k < samples; ++k) {
    seen.push_back(seen_from(k, static_cast<std::size_t>(state.range(0)),
                             near ? near_to(slots, generator) : in_a_box(20, 200.0, generator)));
  }
  Setting options;
  options.at_or_new("delta_theta_deg").value = static_cast<double>(state.range(1));
  const auto matcher = Registry<Matcher>::instance().make("sampled", options, "matching.sampled");
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(matcher->solve({seen[k++ % samples], slots, ownship_weight}));
  }
}
void sampled_cases(benchmark::internal::Benchmark* b) {
  b->ArgNames({"neighbours", "deg"})->ArgsProduct({{6, 12, 19}, {10, 45}});
  b->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(sampled, random, false, 1.0)->Apply(sampled_cases);
BENCHMARK_CAPTURE(sampled, near, true, 1.0)->Apply(sampled_cases);
BENCHMARK_CAPTURE(sampled, random_light_ownship, false, 0.1)->Apply(sampled_cases);
BENCHMARK_CAPTURE(sampled, near_light_ownship, true, 0.1)->Apply(sampled_cases);

void smooth(benchmark::State& state, const std::string& name) {
  const auto solver = Registry<Solver>::instance().make(name, Setting{}, "solver." + name);
  const Problem problem(Vector2d(0, 0), differentiated<2>(bench::TwoNeighbours{}));
  int evaluations = 0;
  for (auto _ : state) {
    const Solution solution = solver->solve(problem);
    benchmark::DoNotOptimize(solution.cost);
    evaluations = solution.evaluations;
  }
  state.counters["evaluations"] = evaluations;
}

const bool all_registered = [] {
  for (const std::string& name : Registry<Solver>::instance().names()) {
    benchmark::RegisterBenchmark(("solver/" + name).c_str(), [name](auto& state) {
      smooth(state, name);
    })->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace shoal::solvers
