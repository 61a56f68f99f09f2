#include <deque>
#include <optional>
#include <utility>

#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

/// Of the matchings of one vehicle, the size of the search that Rypkema 2015, Alg. 8, makes: every
/// slot is tried as seed, in every rotation, with a matrix of the distances of all points seen.
struct LastSearch final : formations::PlanObserver {
  std::size_t neighbours = 0;  ///< heard for the last plan
  std::optional<double> assignments, distances;

  Wants wants() const override { return {.problems = false}; }

  using SolveObserver::solved;
  void solved(const solvers::MatchingProblem& problem,
              const solvers::MatchingSolution& answer) override {
    if (answer.candidates == 0) return;
    const auto points = static_cast<double>(problem.points.size());
    found_ = static_cast<double>(answer.candidates);
    found_distances_ = *found_ * points * points;
  }

  void planned(const formations::Neighbourhood& seen, const formations::Target&) override {
    neighbours = seen.neighbours.size();
    assignments = std::exchange(found_, std::nullopt);
    distances = std::exchange(found_distances_, std::nullopt);
  }

 private:
  std::optional<double> found_, found_distances_;  // in this plan
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

  formations::PlanObserver* plan_observer(std::size_t) override {
    return &vehicles_.emplace_back();
  }

  void finish(const scenarios::World& world, Results& results) const override {
    LastSearch most;
    bool any = false;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i) || (any && vehicles_[i].neighbours <= most.neighbours)) continue;
      most = vehicles_[i];
      any = true;
    }
    results.add("search_assignments", most.assignments);
    results.add("search_distances", most.distances);
  }

 private:
  std::deque<LastSearch> vehicles_;  // stay where they are
};

const Enrol<Measure, SearchSizeMeasure> enrolled{
    "search_size", "how large the search of a behaviour is that assigns slots"};

}  // namespace
}  // namespace shoal::analysis
