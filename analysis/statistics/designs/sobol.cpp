#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/designs/drawn.hpp"

namespace shoal::analysis {
namespace {

/// The first points of Sobol' sequence: they fill the space of the factors evenly, and the first
/// half of them is the smaller design.
struct Sobol final : Design {
  std::int64_t samples = 64;
  std::int64_t seed = 1;
  Origin origin;

  static void declare(Options<Sobol>& o) {
    o.integer("samples", &Sobol::samples, "", in(1, 1e7), "number of cells, a power of two");
    o.integer("seed", &Sobol::seed, "", in(0, 9e15),
              "of the digital shift; another seed draws other cells");
  }

  std::optional<std::string> complaint() const {
    return power_of_two_complaint("samples", samples);
  }

  Eigen::MatrixXd cells(std::span<const int> levels) const override {
    require_drawable(levels, static_cast<double>(samples), origin);
    return sobol_points(samples, static_cast<Eigen::Index>(levels.size()),
                        static_cast<std::uint64_t>(seed), origin);
  }
};

const Register<Design, Sobol> registered{
    "sobol", "points of Sobol' sequence, randomised by a digital shift (Sobol' 1967)"};

}  // namespace
}  // namespace shoal::analysis
