#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/solvers/matching/matching.hpp"

namespace shoal::analysis {
namespace {

/// Of a matching problem, the size of the search that Rypkema 2015, Alg. 8, makes: every slot is
/// tried as seed, in every rotation, with a matrix of the distances of all points seen.
struct SearchSize final : solvers::SolveObserver {
  std::optional<double> assignments, distances;

  void solved(const solvers::Solved& what) override {
    const auto* problem = what.problem<solvers::MatchingProblem>();
    const auto* answer = what.answer<solvers::MatchingSolution>();
    if (!problem || !answer || answer->candidates == 0) return;
    const auto points = static_cast<double>(problem->points.size());
    assignments = static_cast<double>(answer->candidates);
    distances = *assignments * points * points;
  }
};

/// How large the search of a behaviour is that assigns slots (Rypkema 2015, sec. 3.7): that of the
/// vehicle with the most neighbours, as it last planned. A size, not a time: what bounds rule out
/// is counted. Nothing for other behaviours.
class SearchSizeMeasure final : public Measure {
 public:
  static void declare(Options<SearchSizeMeasure>&) {}

  std::vector<Quantity> values() const override {
    return {{"search_assignments", "", "assignments that Alg. 8 solves for a target"},
            {"search_distances", "", "distances that it computes for them"}};
  }

  void finish(const scenarios::World& world, Results& results) const override {
    SearchSize size;
    std::optional<std::size_t> most;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const auto heard = [&](std::size_t of) { return world.planner(of).last_neighbours().size(); };
      if (!world.lost(i) && (!most || heard(i) > heard(*most))) most = i;
    }
    if (most) {
      const auto& waypoint = world.scenario().waypoint;
      const formations::Planner& planner = world.planner(*most);
      solvers::SolveObserver* const observers[] = {&size};
      world.behaviour().step(
          {.neighbours = planner.last_neighbours(),
           .own_slot = planner.own_slot(),
           .own = world.swarm().own_state(*most),
           .obstacles = world.obstacles(),
           .waypoint = waypoint ? waypoint->place() : Eigen::Vector2d::Zero().eval()},
          world.plan(), formations::Solving(nullptr, observers));
    }
    results.add("search_assignments", size.assignments);
    results.add("search_distances", size.distances);
  }
};

const Register<Measure, SearchSizeMeasure> registered{
    "search_size", "how large the search of a behaviour is that assigns slots"};

}  // namespace
}  // namespace shoal::analysis
