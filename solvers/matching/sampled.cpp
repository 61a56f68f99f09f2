#include <algorithm>
#include <cmath>
#include <tuple>

#include "shoal/core/angles.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"
#include "shoal/solvers/matching/slot_subsets.hpp"

namespace shoal::solvers {
namespace {

enum class Centroids : std::uint8_t { weighted, plain };

struct SampledOptions {
  double tie_m = 0.5;
  Centroids centroids = Centroids::weighted;

  static void declare(Options<SampledOptions>& o) {
    o.number("tie_m", &SampledOptions::tie_m, "m", at_least(0.0),
             "slots as far from the seed as the last one taken, within this, are taken too");
    o.word("centroids", &SampledOptions::centroids,
           {{"weighted", Centroids::weighted}, {"plain", Centroids::plain}},
           "what is aligned: centroids with the ownship weight on the own point and on the seed "
           "(the text of Alg. 8), or plain means (the author's program)");
  }
};

// What is kept from call to call of a thread.
struct Workspace {
  struct Visit {
    std::size_t subset;
    double bound_below;
  };

  Turns turns{360.0};
  SlotSubsets subsets;
  RotationSearch search;
  std::vector<Eigen::Vector2d> points;
  std::vector<Visit> visits;
  std::vector<TurnedMatch> found;
  std::vector<int> slot_of_point;
  // What won last. Whoever asks again has hardly moved: it bounds the search, whatever it is.
  std::size_t last_subset = 0;
  int last_turn = 0;
};

bool finite(std::span<const Eigen::Vector2d> points) {
  return std::ranges::all_of(points, [](const Eigen::Vector2d& p) { return p.allFinite(); });
}

/// Tries every slot as seed of the part of the plan that is seen, and every rotation by a multiple
/// of delta theta; the cheapest assignment wins (Rypkema 2015, sec. 3.7, Alg. 8).
class Sampled final : public Matcher {
 public:
  explicit Sampled(const SampledOptions& options) : options_(options) {}

  MatchingSolution solve(const MatchingProblem& problem) const override {
    const double own_weight =
        options_.centroids == Centroids::weighted ? problem.ownship_weight : 1.0;
    const double weight = own_weight + static_cast<double>(problem.points.size()) - 1.0;
    if (problem.points.empty() || problem.points.size() > problem.slots.size() ||
        !(problem.delta_theta_deg > 0.0 && problem.delta_theta_deg <= 360.0) ||
        !std::isfinite(problem.ownship_weight) || problem.ownship_weight < 0.0 || !(weight > 0.0) ||
        !finite(problem.points) || !finite(problem.slots)) {
      return {};
    }
    thread_local Workspace work;
    if (work.turns.step_deg() != problem.delta_theta_deg) {
      work.turns = Turns(problem.delta_theta_deg);
    }

    Eigen::Vector2d centre = (own_weight - 1.0) * problem.points.front();
    for (const Eigen::Vector2d& p : problem.points) centre += p;
    centre /= weight;
    work.points.clear();
    for (const Eigen::Vector2d& p : problem.points) work.points.push_back(p - centre);
    work.search.set_points(work.points);

    const auto& subsets =
        work.subsets.of(static_cast<int>(problem.points.size()), problem.slots,
                        {.tie_m = options_.tie_m, .seed_weight = own_weight}, work.turns);
    return assemble(subsets, best_of(subsets, work), work);
  }

 private:
  // Promising subsets come first, so that the others are soon ruled out; which one wins does not
  // depend on that order.
  std::size_t best_of(const std::vector<SlotSubset>& subsets, Workspace& work) const {
    work.visits.clear();
    for (std::size_t i = 0; i < subsets.size(); ++i) {
      work.visits.push_back({i, work.search.bound_below(subsets[i].aligned)});
    }
    std::ranges::sort(work.visits, [](const auto& a, const auto& b) {
      return std::tie(a.bound_below, a.subset) < std::tie(b.bound_below, b.subset);
    });
    work.found.assign(subsets.size(), {});
    work.search.match(work.turns, subsets[std::min(work.last_subset, subsets.size() - 1)].aligned,
                      std::min(work.last_turn, work.turns.count() - 1));
    double least = work.search.cost();
    for (const auto& [subset, bound_below] : work.visits) {
      // One tie between subsets and one between turns.
      const double limit = least + 2.0 * cost_tie_m;
      if (bound_below > limit) break;
      work.found[subset] = work.search.search(work.turns, subsets[subset].aligned, limit);
      least = std::min(least, work.found[subset].cost);
    }
    std::size_t winner = 0;
    while (work.found[winner].cost > least + cost_tie_m) ++winner;
    work.last_subset = winner;
    work.last_turn = work.found[winner].turn;
    return winner;
  }

  MatchingSolution assemble(const std::vector<SlotSubset>& subsets, std::size_t winner,
                            Workspace& work) const {
    const SlotSubset& subset = subsets[winner];
    const int turn = work.found[winner].turn;
    work.search.match(work.turns, subset.aligned, turn);
    work.slot_of_point.clear();
    for (const int column : work.search.slot_of_point()) {
      work.slot_of_point.push_back(subset.slot[static_cast<std::size_t>(column)]);
    }
    return {.slot_of_point = work.slot_of_point,
            .cost = work.search.cost(),
            .rotation = wrapped(work.turns.angle(turn)),
            .status = MatchingStatus::matched};
  }

  SampledOptions options_;
};

const Enrol<Matcher, SampledOptions> enrolled{
    "sampled",
    "every slot as seed, rotations by multiples of delta theta, optimal assignment in each "
    "(Rypkema 2015, sec. 3.7)",
    [](const SampledOptions& options) { return std::make_unique<Sampled>(options); }};

}  // namespace
}  // namespace shoal::solvers
