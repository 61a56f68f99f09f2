#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/designs/drawn.hpp"

namespace shoal::analysis {
namespace {

/// The design that Sobol' indices are estimated from (Saltelli et al. 2010): for each base sample
/// the rows A, AB_1 ... AB_k, B, where AB_i is A with the i-th value of B. For indices of pairs,
/// the rows BA_1 ... BA_k, B with the i-th value of A, stand before B (Saltelli 2002). The rows of
/// the first base samples are thus the smaller design.
struct Saltelli final : Design {
  std::int64_t base_samples = 256;
  std::int64_t seed = 1;
  bool second_order = false;
  Origin origin;

  static void declare(Options<Saltelli>& o) {
    using S = Saltelli;
    o.integer("base_samples", &S::base_samples, "", in(1, 1e7),
              "a power of two; each makes as many cells as there are factors, and two");
    o.integer("seed", &S::seed, "", in(0, 9e15),
              "of the digital shift; another seed draws other cells");
    o.flag("second_order", &S::second_order,
           "also the cells for indices of pairs of factors: twice as many as factors, and two");
  }

  std::optional<std::string> complaint() const {
    return power_of_two_complaint("base_samples", base_samples);
  }

  Eigen::MatrixXd cells(std::span<const int> levels) const override {
    const auto k = static_cast<Eigen::Index>(levels.size());
    const Eigen::Index rows = second_order ? 2 * k + 2 : k + 2;
    require_drawable(levels, static_cast<double>(base_samples) * static_cast<double>(rows), origin);
    // A takes the first columns, whose points are spread best (Saltelli et al. 2010).
    const Eigen::MatrixXd points =
        sobol_points(base_samples, 2 * k, static_cast<std::uint64_t>(seed), origin);
    Eigen::MatrixXd cells(base_samples * rows, k);
    for (Eigen::Index j = 0; j < base_samples; ++j) {
      auto block = cells.middleRows(j * rows, rows);
      block.topRows(k + 1).rowwise() = points.row(j).head(k);
      block.bottomRows(rows - k - 1).rowwise() = points.row(j).tail(k);
      for (Eigen::Index i = 0; i < k; ++i) {
        block(1 + i, i) = points(j, k + i);
        if (second_order) block(1 + k + i, i) = points(j, i);
      }
    }
    return cells;
  }
};

const Register<Design, Saltelli> registered{
    "saltelli", "the cells that Sobol' indices are estimated from (Saltelli et al. 2010)"};

}  // namespace
}  // namespace shoal::analysis
