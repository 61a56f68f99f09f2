#include "shoal/solvers/matching/sampled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>

#include "shoal/core/angles.hpp"
#include "shoal/core/interruption.hpp"
#include "shoal/core/text.hpp"
#include "shoal/solvers/matching/points.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"
#include "shoal/solvers/matching/slot_subsets.hpp"

namespace shoal::solvers {
namespace {

// Metres. The wider, the longer it holds, and the more matches there are to look at.
constexpr double margin_m = 60.0;
constexpr std::size_t most_candidates = 8;
constexpr std::size_t subsets_unchecked = 64;
// Points x rotations x slots.
constexpr double most_placements = 1e9;
constexpr int longest_pause = 32;

/// What is remembered of a caller.
///
/// The matches that were worth a look last time: a distance changes by no more than its point has
/// moved, so while the points have moved by less than the margin in all, every other match still
/// costs more than the best of these did.
struct Recollection {
  struct Candidate {
    std::size_t subset;
    int turn;
    double cost;
  };

  std::shared_ptr<const SlotSubsets> subsets;
  bool valid = false;  ///< whether candidates of these subsets are remembered
  std::vector<Eigen::Vector2d> points;
  std::vector<Candidate> candidates;  ///< by subset, then by turn
  double others = 0.0;                ///< all other matches cost this, or more
  // Remembering costs more than finding: while points move far between two calls it is tried now
  // and then.
  int pause = 0, next_pause = 1;
  // What won last: it bounds the search, whatever it is.
  std::size_t last_subset = 0;
  int last_turn = 0;
};

// What is kept from call to call of a thread: room, and no numbers.
struct Workspace {
  struct Visit {
    std::size_t subset;
    double bound_below;
  };

  RotationSearch search;
  std::vector<Eigen::Vector2d> points;
  std::vector<Visit> visits;
  std::vector<TurnedMatch> found;
  std::vector<int> slot_of_point;
};

/// The subsets of plans that were met, shared by all callers and threads.
class MetSubsets {
 public:
  std::shared_ptr<const SlotSubsets> of(int points, std::span<const Eigen::Vector2d> slots,
                                        const SubsetRule& rule, const Turns& turns) const {
    const std::scoped_lock lock(mutex_);
    for (const auto& met : met_) {
      if (met->are_of(points, slots, rule)) return met;
    }
    if (met_.size() == most) met_.erase(met_.begin());
    return met_.emplace_back(std::make_shared<const SlotSubsets>(points, slots, rule, turns));
  }

 private:
  static constexpr std::size_t most = 256;

  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<const SlotSubsets>> met_;
};

class SampledMatcher final : public Matcher {
 public:
  explicit SampledMatcher(const Sampled& options)
      : options_(options), turns_(options.delta_theta_deg) {}

  std::unique_ptr<Memory> new_memory() const override {
    return std::make_unique<MemoryOf<Recollection>>();
  }

  std::optional<std::string> refuses(const MatchingProblem& problem) const override {
    const double work = static_cast<double>(problem.points.size()) *
                        static_cast<double>(problem.slots.size()) * turns_.count();
    if (work <= most_placements) return std::nullopt;
    return "takes at most " + shortest(most_placements) +
           " points x rotations x slots, and here are " + shortest(work) +
           "; give fewer points or slots, or a greater delta_theta_deg";
  }

  using Matcher::solve;
  MatchingSolution solve(const MatchingProblem& problem, Memory* memory) const override {
    const double own_weight =
        options_.centroids == Centroids::weighted ? problem.ownship_weight : 1.0;
    const double weight = own_weight + static_cast<double>(problem.points.size()) - 1.0;
    if (problem.points.empty() || problem.points.size() > problem.slots.size() ||
        !std::isfinite(problem.ownship_weight) || problem.ownship_weight < 0.0 || !(weight > 0.0) ||
        !all_finite(problem.points) || !all_finite(problem.slots)) {
      return {};
    }
    thread_local Workspace work;
    Eigen::Vector2d centre = (own_weight - 1.0) * problem.points.front();
    for (const Eigen::Vector2d& p : problem.points) centre += p;
    centre /= weight;
    work.points.clear();
    for (const Eigen::Vector2d& p : problem.points) work.points.push_back(p - centre);
    work.search.set_points(work.points);

    Recollection first_time;
    Recollection& last =
        memory ? static_cast<MemoryOf<Recollection>*>(memory)->content : first_time;
    const auto points = static_cast<int>(problem.points.size());
    const SubsetRule rule{.tie_m = options_.tie_m, .seed_weight = own_weight};
    if (!last.subsets || !last.subsets->are_of(points, problem.slots, rule)) {
      last.subsets = met_.of(points, problem.slots, rule, turns_);
      last.valid = false;
    }
    std::optional<Place> best = remembered(last, work);
    if (!best) best = best_of(last, memory && worth_remembering(last), work);
    return assemble(*last.subsets, *best, problem.slots.size(), work);
  }

 private:
  struct Place {
    std::size_t subset;
    int turn;
  };

  /// The best match, if it is certain to be one of those remembered.
  std::optional<Place> remembered(Recollection& last, Workspace& work) const {
    if (!last.valid) return std::nullopt;
    const std::span<const SlotSubset> subsets = last.subsets->all();
    double moved = 0.0;
    for (std::size_t i = 0; i < work.points.size(); ++i) {
      moved += (work.points[i] - last.points[i]).norm();
    }
    if (moved > margin_m) return std::nullopt;
    double least = std::numeric_limits<double>::infinity();
    for (Recollection::Candidate& candidate : last.candidates) {
      work.search.match(turns_, subsets[candidate.subset].aligned, candidate.turn);
      candidate.cost = work.search.cost();
      least = std::min(least, candidate.cost);
    }
    // Ties reach from the best match over that of its subset to its first turn.
    if (least + 4.0 * cost_tie_m > last.others - moved) return std::nullopt;
    last.pause = 0;
    last.next_pause = 1;
    return first_of_the_least(last.candidates, least);
  }

  /// The first subset whose first turn of the least is one of the least.
  static Place first_of_the_least(const std::vector<Recollection::Candidate>& candidates,
                                  double least) {
    for (auto first = candidates.begin();;) {
      const auto end = std::find_if(first, candidates.end(),
                                    [&](const auto& c) { return c.subset != first->subset; });
      const double least_here = std::min_element(first, end, [](const auto& a, const auto& b) {
                                  return a.cost < b.cost;
                                })->cost;
      while (first->cost > least_here + cost_tie_m) ++first;
      if (first->cost <= least + cost_tie_m) return {first->subset, first->turn};
      first = end;
    }
  }

  // Promising subsets come first, so that the others are soon ruled out; which one wins does not
  // depend on that order.
  Place best_of(Recollection& last, bool remember, Workspace& work) const {
    const std::span<const SlotSubset> subsets = last.subsets->all();
    const double margin = remember ? margin_m : 0.0;
    last.valid = false;
    last.candidates.clear();
    work.visits.clear();
    for (std::size_t i = 0; i < subsets.size(); ++i) {
      if (i % subsets_unchecked == subsets_unchecked - 1) check_interruption();
      work.visits.push_back({i, work.search.bound_below(subsets[i].aligned)});
    }
    std::ranges::sort(work.visits, [](const auto& a, const auto& b) {
      return std::tie(a.bound_below, a.subset) < std::tie(b.bound_below, b.subset);
    });
    work.found.assign(subsets.size(), {});
    work.search.match(turns_, subsets[std::min(last.last_subset, subsets.size() - 1)].aligned,
                      last.last_turn);
    double least = work.search.cost();
    for (const auto& [subset, bound_below] : work.visits) {
      // One tie between subsets and one between turns.
      const double limit = least + margin + 2.0 * cost_tie_m;
      if (bound_below > limit) break;
      work.found[subset] = work.search.search(turns_, subsets[subset].aligned, limit, margin);
      least = std::min(least, work.found[subset].cost);
      if (!remember) continue;
      work.search.visit_turns([&, of = subset](int turn, double cost) {
        last.candidates.push_back({of, turn, cost});
      });
    }
    if (remember) keep(last, least + margin, work);
    std::size_t winner = 0;
    while (work.found[winner].cost > least + cost_tie_m) ++winner;
    last.last_subset = winner;
    last.last_turn = work.found[winner].turn;
    return {winner, work.found[winner].turn};
  }

  static bool worth_remembering(Recollection& last) {
    if (last.pause > 0) {
      --last.pause;
      return false;
    }
    last.pause = last.next_pause;
    last.next_pause = std::min(2 * last.next_pause, longest_pause);
    return true;
  }

  static void keep(Recollection& last, double others, const Workspace& work) {
    std::erase_if(last.candidates, [&](const auto& c) { return c.cost > others; });
    if (last.candidates.size() > most_candidates) return;
    std::ranges::sort(last.candidates, [](const auto& a, const auto& b) {
      return std::tie(a.subset, a.turn) < std::tie(b.subset, b.turn);
    });
    last.points = work.points;
    last.others = others;
    last.valid = true;
  }

  MatchingSolution assemble(const SlotSubsets& subsets, const Place& best, std::size_t slots,
                            Workspace& work) const {
    const SlotSubset& subset = subsets.all()[best.subset];
    work.search.match(turns_, subset.aligned, best.turn);
    work.slot_of_point.clear();
    for (const int column : work.search.slot_of_point()) {
      work.slot_of_point.push_back(subset.slot[static_cast<std::size_t>(column)]);
    }
    MatchingSolution solution;
    solution.status = Status::converged;
    solution.cost = work.search.cost();
    solution.slot_of_point = work.slot_of_point;
    solution.rotation = wrapped(turns_.angle(best.turn));
    solution.candidates = static_cast<std::int64_t>(slots) * turns_.count();
    return solution;
  }

  Sampled options_;
  Turns turns_;
  MetSubsets met_;
};

const Register<Matcher, Sampled> registered{
    "sampled",
    "every slot as seed, rotations by multiples of delta theta, optimal assignment in each "
    "(Rypkema 2015, sec. 3.7)",
    [](const Sampled& options) { return std::make_unique<SampledMatcher>(options); }};

}  // namespace

void Sampled::declare(Options<Sampled>& o) {
  o.number("delta_theta_deg", &Sampled::delta_theta_deg, "deg", delta_theta_range_deg(),
           "step between the rotations tried; the thesis used 45 without currents, 10 in them");
  o.number("tie_m", &Sampled::tie_m, "m", at_least(0.0),
           "slots as far from the seed as the last one taken, within this, are taken too");
  o.word("centroids", &Sampled::centroids,
         {{"weighted", Centroids::weighted}, {"plain", Centroids::plain}},
         "what is aligned: centroids with the ownship weight on the own point and on the seed "
         "(the text of Alg. 8), or plain means (the author's program)");
}

}  // namespace shoal::solvers
