// One target of one vehicle, from pings already heard.

#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "shoal/formations/behaviour.hpp"

namespace {

using namespace shoal::formations;

/// A square lattice of rows x 5 slots and what a vehicle near its middle hears of it.
struct Scene {
  Plan plan;
  std::vector<Neighbour> heard;
  int own;
};

Scene scene(int neighbours, bool formed) {
  shoal::Setting rows;
  rows.at_or_new("rows").value = std::int64_t{5};
  rows.at_or_new("columns").value = std::int64_t{4};
  Plan plan = shoal::Registry<PlanSource>::instance().make("square", rows, "plan.square")->plan();
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 20.0);
  std::uniform_real_distribution<double> box(-100.0, 100.0);

  const int own = 7;
  std::vector<int> order;
  for (int i = 0; i < plan.size(); ++i) {
    if (i != own) order.push_back(i);
  }
  std::ranges::sort(order, {}, [&](int i) { return (plan.slot(i) - plan.slot(own)).norm(); });
  std::vector<Neighbour> heard;
  for (int k = 0; k < neighbours; ++k) {
    const int i = order[static_cast<std::size_t>(k)];
    const Eigen::Vector2d away = plan.slot(i) - plan.slot(own);
    const Eigen::Vector2d place =
        formed ? Eigen::Vector2d(away.x() + noise(generator), away.y() + noise(generator))
               : Eigen::Vector2d(box(generator), box(generator));
    heard.push_back({place, 10.0, i});
  }
  return {std::move(plan), std::move(heard), own};
}

using Choices = std::vector<std::pair<const char*, const char*>>;

void target(benchmark::State& state, const char* behaviour, int neighbours, bool formed,
            const Choices& choices = {}, double delta_theta_deg = 0.0) {
  const Scene seen = scene(neighbours, formed);
  shoal::Setting options;
  if (delta_theta_deg > 0.0) {
    assign(options, "matching.sampled.delta_theta_deg", {delta_theta_deg, {}});
  }
  for (const auto& [key, kind] : choices) assign(options, key, {std::string(kind), {}});
  const auto member = shoal::Registry<Behaviour>::instance().make(behaviour, options, behaviour);
  shoal::OwnedMemory memory = member->new_memory();
  const Solving solving(memory.get());
  for (auto _ : state) {
    benchmark::DoNotOptimize(member->step({seen.heard, seen.own}, seen.plan, solving));
  }
}

BENCHMARK_CAPTURE(target, rigid_10_neighbours, "rigid_registration", 10, true);
BENCHMARK_CAPTURE(target, rigid_10_neighbours_huber, "rigid_registration", 10, true,
                  Choices{{"loss.kind", "huber"}, {"registration.kind", "newton"}});
BENCHMARK_CAPTURE(target, pairwise_10_neighbours, "pairwise_referencing", 10, true);
BENCHMARK_CAPTURE(target, pairwise_10_neighbours_huber, "pairwise_referencing", 10, true,
                  Choices{{"loss.kind", "huber"}});
BENCHMARK_CAPTURE(target, attraction_repulsion_10_neighbours, "attraction_repulsion", 10, true);
BENCHMARK_CAPTURE(target, attraction_repulsion_10_neighbours_expression, "attraction_repulsion", 10,
                  true, Choices{{"potential.kind", "expression"}});
BENCHMARK_CAPTURE(target, attraction_repulsion_10_neighbours_k_nearest, "attraction_repulsion", 10,
                  true, Choices{{"selection.kind", "k_nearest"}});
BENCHMARK_CAPTURE(target, attraction_repulsion_10_neighbours_delaunay, "attraction_repulsion", 10,
                  true, Choices{{"selection.kind", "delaunay"}});
BENCHMARK_CAPTURE(target, assignment_12_neighbours_10_deg_formed, "assignment_registration", 12,
                  true, Choices{}, 10.0);
BENCHMARK_CAPTURE(target, assignment_12_neighbours_10_deg_in_a_box, "assignment_registration", 12,
                  false, Choices{}, 10.0);

}  // namespace
