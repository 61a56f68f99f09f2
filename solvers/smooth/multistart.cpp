#include "shoal/solvers/smooth/multistart.hpp"

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

class MultistartSolver final : public Solver {
 public:
  explicit MultistartSolver(const Multistart& options)
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

  Multistart options_;
  std::shared_ptr<const Solver> solver_;
};

const Register<Solver, Multistart> registered{
    "multistart", "the best answer of another solver from many starts",
    [](const Multistart& options) { return std::make_unique<MultistartSolver>(options); }};

}  // namespace

void Multistart::declare(Options<Multistart>& o) {
  using M = Multistart;
  o.integer("starts", &M::starts, "", in(1, 1e6),
            "solves: the first from the problem's start, the others from points spread evenly");
  o.number("radius_m", &M::radius_m, "m", above(0.0),
           "half the side of the box round the start, for problems without bounds");
  o.number("same_minimum_m", &M::same_minimum_m, "m", above(0.0),
           "answers closer than this are one minimum");
  o.integer("seed", &M::seed, "", in(0, 9007199254740992.0), "moves the starts as a whole");
  o.choice("solver", &M::solver, "solves from each start, with its own budget");
}

}  // namespace shoal::solvers
