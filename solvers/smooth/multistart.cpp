#include <boost/random/sobol.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "shoal/core/random.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;

struct MultistartOptions {
  std::int64_t starts = 32;
  double radius_m = 500.0;
  double same_minimum_m = 0.1;
  std::int64_t seed = 1;
  Choice<Solver> solver{"newton"};

  static void declare(Options<MultistartOptions>& o) {
    using M = MultistartOptions;
    o.integer("starts", &M::starts, "", in(1, 1e6),
              "solves: the first from the problem's start, the others from points spread evenly");
    o.number("radius_m", &M::radius_m, "m", above(0.0),
             "half the side of the box round the start, for problems without bounds");
    o.number("same_minimum_m", &M::same_minimum_m, "m", above(0.0),
             "answers closer than this are one minimum");
    o.integer("seed", &M::seed, "", in(0, 9007199254740992.0), "moves the starts as a whole");
    o.choice("solver", &M::solver, "solves from each start, with its own budget");
  }
};

/// The best answer of one solver from many starts: a Sobol sequence (low discrepancy), moved by a
/// random shift modulo one, which keeps its evenness (Cranley and Patterson 1976).
class Multistart final : public Solver {
 public:
  explicit Multistart(const MultistartOptions& options)
      : options_(options), solver_(options.solver.make()) {}

  Solution solve(const Problem& problem) const override {
    const auto begin = std::chrono::steady_clock::now();
    Solution best = solver_->solve(problem);
    if (best.status == Status::bad_input) return best;
    std::vector<Vector> minima;
    note(best, minima);
    int evaluations = best.evaluations;

    const auto n = static_cast<std::size_t>(problem.dimension());
    boost::random::sobol sequence(n);
    sequence.discard(n);  // its first point is the origin
    const std::vector<double> shift = shifts(n);
    Problem from_elsewhere = problem;
    for (std::int64_t k = 1; k < options_.starts; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        const double u = static_cast<double>(sequence()) * 0x1p-64 + shift[i];
        const auto [low, high] = range(problem, static_cast<Eigen::Index>(i));
        const double place = low + (high - low) * (u - std::floor(u));
        from_elsewhere.start[static_cast<Eigen::Index>(i)] = std::clamp(place, low, high);
      }
      const Solution next = solver_->solve(from_elsewhere);
      evaluations += next.evaluations;
      note(next, minima);
      if (better(next, best)) best = next;
    }
    best.evaluations = evaluations;
    best.distinct_minima = static_cast<int>(minima.size());
    best.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return best;
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (auto why = solver_->refuses(problem)) return "its solver " + *why;
    return std::nullopt;
  }
  std::optional<std::string> one_at_a_time() const override { return solver_->one_at_a_time(); }

 private:
  std::vector<double> shifts(std::size_t n) const {
    const RandomStreams random(static_cast<std::uint64_t>(options_.seed));
    std::vector<double> shift(n);
    for (std::size_t i = 0; i < n; ++i) shift[i] = random.uniform(Purpose::solver, 0, i)[0];
    return shift;
  }

  std::pair<double, double> range(const Problem& problem, Eigen::Index i) const {
    const double centre = problem.start[i];
    double low = centre - options_.radius_m, high = centre + options_.radius_m;
    if (problem.lower && std::isfinite((*problem.lower)[i])) low = (*problem.lower)[i];
    if (problem.upper && std::isfinite((*problem.upper)[i])) high = (*problem.upper)[i];
    return {low, std::max(low, high)};
  }

  void note(const Solution& found, std::vector<Vector>& minima) const {
    if (found.status != Status::converged) return;
    for (const Vector& known : minima) {
      if ((known - found.x).norm() < options_.same_minimum_m) return;
    }
    minima.push_back(found.x);
  }

  static bool better(const Solution& a, const Solution& b) {
    if (a.usable() != b.usable()) return a.usable();
    return a.cost < b.cost || (std::isnan(b.cost) && !std::isnan(a.cost));
  }

  MultistartOptions options_;
  std::shared_ptr<const Solver> solver_;
};

const Register<Solver, MultistartOptions> registered{
    "multistart", "the best answer of another solver from many starts",
    [](const MultistartOptions& options) { return std::make_unique<Multistart>(options); }};

}  // namespace
}  // namespace shoal::solvers
