#include "shoal/solvers/smooth/grid.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;

class GridSolver final : public Solver {
 public:
  explicit GridSolver(const Grid& options) : options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, Limits::of(options_));
    if (!attempt.open()) return attempt.finish(0, "");

    const Vector lower = attempt.lower(), upper = attempt.upper();
    const double intervals = static_cast<double>(options_.points_per_axis - 1);
    Vector mesh = (upper - lower) / intervals;
    Vector low = lower, high = upper;
    while (visit_all(attempt, low, high)) {
      const Vector best = attempt.best();
      if (!best.allFinite()) break;
      // At the edge of what was seen, it may go on outside: down a valley, say.
      const bool at_edge =
          ((best - low).array() < 1.5 * mesh.array() && low.array() > lower.array()).any() ||
          ((high - best).array() < 1.5 * mesh.array() && high.array() < upper.array()).any();
      if (!at_edge) {
        if (mesh.maxCoeff() <= options_.x_tolerance_m) break;
        mesh *= zoom;
      }
      low = (best - 0.5 * intervals * mesh).cwiseMax(lower);
      high = (best + 0.5 * intervals * mesh).cwiseMin(upper);
    }
    return attempt.finish(0, "the mesh is as fine as asked, or the budget is spent");
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (!problem.lower || !problem.upper ||
        !(problem.lower->allFinite() && problem.upper->allFinite())) {
      return "needs finite bounds: it tries the whole box";
    }
    if (problem.constrained()) {
      return "takes no constraints: along a curved edge the best lies between its points";
    }
    if (problem.dimension() > most_unknowns)
      return "takes at most three unknowns: a grid of more has no end";
    return std::nullopt;
  }

 private:
  static constexpr double zoom = 0.2;
  static constexpr int most_unknowns = 3;

  bool visit_all(Attempt& attempt, const Vector& low, const Vector& high) const {
    const int n = attempt.unknowns();
    const auto last = options_.points_per_axis - 1;
    std::array<std::int64_t, most_unknowns> axes{};
    const std::span<std::int64_t> index(axes.data(), static_cast<std::size_t>(n));
    Vector y(n);
    for (;;) {
      for (int i = 0; i < n; ++i) {
        const double share =
            static_cast<double>(index[static_cast<std::size_t>(i)]) / static_cast<double>(last);
        y[i] = std::min(low[i] + share * (high[i] - low[i]), high[i]);
      }
      double cost = 0.0;
      if (attempt.evaluate(y.data(), cost) == Attempt::Outcome::stop) return false;
      std::size_t axis = 0;
      while (axis < index.size() && index[axis] == last) index[axis++] = 0;
      if (axis == index.size()) return true;
      ++index[axis];
    }
  }

  Grid options_;
};

const Register<Solver, Grid> registered{
    "grid", "every point of a grid over the box, then of finer ones about the best: an oracle",
    [](const Grid& options) { return std::make_unique<GridSolver>(options); }};

}  // namespace

void Grid::declare(Options<Grid>& o) {
  declare_limits(o);
  o.integer("points_per_axis", &Grid::points_per_axis, "", in(5, 1e5),
            "points along each unknown, at every level");
}

}  // namespace shoal::solvers
