#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/designs/drawn.hpp"
#include "shoal/core/random.hpp"

namespace shoal::analysis {
namespace {

/// Each of n equal parts of every factor's range holds one cell (McKay, Beckman and Conover 1979).
struct LatinHypercube final : Design {
  std::int64_t samples = 64;
  std::int64_t seed = 1;
  Origin origin;

  static void declare(Options<LatinHypercube>& o) {
    using L = LatinHypercube;
    o.integer("samples", &L::samples, "", in(1, 1e7), "number of cells");
    o.integer("seed", &L::seed, "", in(0, 9e15), "of the draw; another seed draws other cells");
  }

  Eigen::MatrixXd cells(std::span<const int> levels) const override {
    require_drawable(levels, static_cast<double>(samples), origin);
    const RandomStreams random(static_cast<std::uint64_t>(seed));
    Eigen::MatrixXd cells(samples, levels.size());
    for (Eigen::Index f = 0; f < cells.cols(); ++f) {
      const auto draw = [&](Eigen::Index i) {
        return random.uniform(Purpose::design, static_cast<std::uint32_t>(f),
                              static_cast<std::uint64_t>(i));
      };
      const std::vector<Eigen::Index> strata =
          shuffled(samples, [&](Eigen::Index i) { return draw(i)[0]; });
      for (Eigen::Index i = 0; i < samples; ++i) {
        const auto stratum = static_cast<double>(strata[static_cast<std::size_t>(i)]);
        cells(i, f) = (stratum + draw(i)[1]) / static_cast<double>(samples);
      }
    }
    return cells;
  }
};

const Register<Design, LatinHypercube> registered{
    "latin_hypercube",
    "one cell in each of n equal parts of every factor's range (McKay, Beckman and Conover 1979)"};

}  // namespace
}  // namespace shoal::analysis
