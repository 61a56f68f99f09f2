#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace shoal::solvers {

enum class AssignmentStatus : std::uint8_t {
  optimal,
  budget,       ///< complete, but perhaps not the cheapest: the rows to be scanned ran out
  above_bound,  ///< abandoned: every assignment costs at least the bound given
  infeasible,   ///< the forbidden (infinite) entries leave some row without a column
  bad_input,    ///< NaN or -infinity in the costs, more rows than columns, or a wrong size
};

/// Linear assignment: each row of a rows x columns cost matrix (rows <= columns) gets its own
/// column so that the sum is least. +infinity forbids a pair.
///
/// Shortest augmenting paths with column prices (Jonker and Volgenant 1987). Row minima and prices
/// bound the final cost from below at every stage, so a search over many matrices can abandon one
/// as soon as it cannot beat `bound`. Deterministic: equal choices fall to the lowest column.
/// Keeps its work space between calls: one object per thread, nothing allocated once grown.
class AssignmentSolver {
 public:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  static constexpr std::int64_t any_number = std::numeric_limits<std::int64_t>::max();

  /// `costs` is row-major. On `optimal` and `budget`, column_of() and cost() hold the answer. When
  /// `most_rows` were scanned, the rows that are left take the cheapest of the free columns.
  AssignmentStatus solve(std::span<const double> costs, int rows, int columns,
                         double bound = unbounded, std::int64_t most_rows = any_number);

  /// Like solve() for a matrix of the same shape as the last, whose prices it starts from: fast
  /// where the costs changed little. Of several optimal assignments it may find another one.
  AssignmentStatus solve_similar(std::span<const double> costs, double bound = unbounded,
                                 std::int64_t most_rows = any_number);

  /// Makes the next solve_similar() start from nothing.
  void reset(int rows, int columns);

  std::span<const int> column_of() const { return column_of_row_; }
  double cost() const { return cost_; }

  /// How many rows were looked through so far, in whatever matrix: a measure of the work done that
  /// does not depend on the machine.
  std::int64_t rows_scanned() const { return rows_scanned_; }

  /// For any matrix C of this shape, no assignment costs less than
  /// price_sum() + sum over rows i of min over columns j of (C(i, j) - prices()[j]).
  std::span<const double> prices() const { return price_; }
  double price_sum() const;
  /// No row minimum of C - prices() is below min C minus this.
  double highest_price() const;

 private:
  /// A row reached by the search for a path, with the column it would give up.
  struct Step {
    int row, column;
    double distance, offset;
  };
  enum class Path : std::uint8_t { found, above_bound, none };

  AssignmentStatus take_row_minima();
  bool take_free_columns(std::span<const int> rows);
  double sum_of_costs() const;
  Path augment(int row, double rest, double bound);
  bool place_spare_rows(double share, double bound);
  void flip_path(int column, double distance);
  const double* row(int i) const;
  Eigen::Map<const Eigen::ArrayXd> row_array(int i) const;

  int rows_ = 0, columns_ = 0;
  const double* costs_ = nullptr;
  std::vector<double> price_, open_price_, shortest_, share_, zeros_;
  std::vector<int> column_of_row_, row_of_column_, pending_;
  std::vector<Step> steps_;
  double cost_ = 0.0;
  double bound_below_ = 0.0;
  std::int64_t rows_scanned_ = 0;
};

}  // namespace shoal::solvers
