#include "shoal/analysis/statistics/design.hpp"

namespace shoal::analysis {
namespace {

/// Every combination of levels, the last factor running fastest. Without factors, one cell.
struct Grid final : Design {
  Origin origin;

  static void declare(Options<Grid>&) {}

  bool draws() const override { return false; }

  Eigen::MatrixXd cells(std::span<const int> levels) const override {
    double count = 1.0;
    for (const int n : levels) {
      if (n == 0) {
        throw InputError(
            origin, "a grid needs the levels of every factor; give values, or steps to a range");
      }
      count *= n;
    }
    if (count > most_cells) {
      throw InputError(origin,
                       "the grid has more than 10 million cells; leave out levels, or use "
                       "a design that draws its cells (shoal list designs)");
    }
    Eigen::MatrixXd cells(static_cast<Eigen::Index>(count), levels.size());
    Eigen::Index run = 1;  // how many cells in a row share a level
    for (auto f = cells.cols() - 1; f >= 0; --f) {
      const int n = levels[static_cast<std::size_t>(f)];
      for (Eigen::Index i = 0; i < cells.rows(); ++i) {
        cells(i, f) = (static_cast<double>((i / run) % n) + 0.5) / n;
      }
      run *= n;
    }
    return cells;
  }
};

const Register<Design, Grid> registered{"grid", "every combination of the levels of all factors"};

}  // namespace
}  // namespace shoal::analysis
