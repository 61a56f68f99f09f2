#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/designs/drawn.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis {
namespace {

/// Trajectories through a grid of p levels, along which every factor changes once, by
/// delta = p / (2 (p - 1)) up or down (Morris 1991). The first trajectories are the smaller design.
struct Morris final : Design {
  std::int64_t trajectories = 10;
  std::int64_t levels = 4;
  std::int64_t seed = 1;
  Origin origin;

  static void declare(Options<Morris>& o) {
    using M = Morris;
    o.integer("trajectories", &M::trajectories, "", in(1, 1e7),
              "each makes as many cells as there are factors, and one");
    o.integer("levels", &M::levels, "", in(2, 1000), "of the grid; an even number");
    o.integer("seed", &M::seed, "", in(0, 9e15), "of the draw; another seed draws other cells");
  }

  std::optional<std::string> complaint() const {
    if (levels % 2 == 0) return std::nullopt;
    return "levels = " + std::to_string(levels) +
           " is odd, and steps of half the grid would not reach all levels alike; give " +
           std::to_string(levels - 1) + " or " + std::to_string(levels + 1);
  }

  Eigen::MatrixXd cells(std::span<const int> factor_levels) const override {
    const auto k = static_cast<Eigen::Index>(factor_levels.size());
    require_drawable(factor_levels, static_cast<double>(trajectories) * static_cast<double>(k + 1),
                     origin);
    require_equal_steps(factor_levels);
    Eigen::MatrixXd cells(trajectories * (k + 1), k);
    for (Eigen::Index t = 0; t < trajectories; ++t) walk(cells.middleRows(t * (k + 1), k + 1), t);
    return cells;
  }

 private:
  // With n levels, half the grid is n / 2 of them wherever a step starts only if n is even and
  // divides the grid; effects of unequal steps could not be compared.
  void require_equal_steps(std::span<const int> factor_levels) const {
    for (std::size_t f = 0; f < factor_levels.size(); ++f) {
      const int n = factor_levels[f];
      if (n == 0 || (n % 2 == 0 && levels % n == 0)) continue;
      throw InputError(origin,
                       "morris takes equal steps over an even number of levels that divides "
                       "levels = " +
                           std::to_string(levels) + ", and factor " + std::to_string(f + 1) +
                           " has " + std::to_string(n) +
                           "; give it such a number of levels, or a range without steps");
    }
  }

  void walk(Eigen::Ref<Eigen::MatrixXd> rows, Eigen::Index trajectory) const {
    const RandomStreams random(static_cast<std::uint64_t>(seed));
    const auto draw = [&](Eigen::Index factor, Eigen::Index use) {
      return random.uniform(Purpose::design, static_cast<std::uint32_t>(factor),
                            static_cast<std::uint64_t>(2 * trajectory + use));
    };
    const auto place = [&](std::int64_t level) {
      return static_cast<double>(level) / static_cast<double>(levels - 1);
    };
    const Eigen::Index k = rows.cols();
    const std::vector<Eigen::Index> order =
        shuffled(k, [&](Eigen::Index f) { return draw(f, 0)[0]; });
    for (Eigen::Index step = 0; step < k; ++step) {
      const Eigen::Index f = order[static_cast<std::size_t>(step)];
      const auto [start, direction] = draw(f, 1);
      const std::int64_t half = levels / 2;
      const auto low = static_cast<std::int64_t>(start * static_cast<double>(half));
      const std::int64_t high = low + half;
      const bool up = direction < 0.5;
      rows.col(f).head(step + 1).setConstant(place(up ? low : high));
      rows.col(f).tail(k - step).setConstant(place(up ? high : low));
    }
  }
};

const Register<Design, Morris> registered{
    "morris",
    "trajectories that change one factor at a time, for elementary effects (Morris 1991)"};

}  // namespace
}  // namespace shoal::analysis
