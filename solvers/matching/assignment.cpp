#include "shoal/solvers/matching/assignment.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <numeric>

#include "shoal/core/interruption.hpp"
#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

// Rows or steps between two looks: some milliseconds, and never in a small swarm.
constexpr std::size_t steps_unchecked = 64;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void AssignmentSolver::reset(int rows, int columns) {
  rows_ = rows;
  columns_ = columns;
  price_.assign(at(columns), 0.0);
  zeros_.assign(at(columns), 0.0);
  shortest_.resize(at(columns));
  open_price_.resize(at(columns));
  steps_.reserve(at(columns) + 1);
  pending_.reserve(at(rows));
  row_of_column_.resize(at(columns));
  column_of_row_.resize(at(rows));
  share_.resize(at(rows));
}

AssignmentStatus AssignmentSolver::solve(std::span<const double> costs, int rows, int columns,
                                         double bound, std::int64_t most_rows) {
  if (rows < 0 || rows > columns) return AssignmentStatus::bad_input;
  reset(rows, columns);
  return solve_similar(costs, bound, most_rows);
}

// The matrix is thought of as square: columns - rows further rows of zeros take what is left. They
// matter only when the prices come from another matrix.
AssignmentStatus AssignmentSolver::solve_similar(std::span<const double> costs, double bound,
                                                 std::int64_t most_rows) {
  if (costs.size() != at(rows_) * at(columns_)) return AssignmentStatus::bad_input;
  costs_ = costs.data();
  if (const auto status = take_row_minima(); status != AssignmentStatus::optimal) return status;
  if (bound_below_ >= bound) return AssignmentStatus::above_bound;

  const double spare_share = -highest_price();
  const std::int64_t begin = rows_scanned_;
  for (std::size_t k = 0; k < pending_.size(); ++k) {
    const int i = pending_[k];
    if (k % steps_unchecked == steps_unchecked - 1) check_interruption();
    if (rows_scanned_ - begin >= most_rows) {
      if (!take_free_columns(std::span(pending_).subspan(k))) return AssignmentStatus::infeasible;
      cost_ = sum_of_costs();
      return cost_ < bound ? AssignmentStatus::budget : AssignmentStatus::above_bound;
    }
    switch (augment(i, bound_below_ - share_[at(i)], bound)) {
      case Path::found:
        break;
      case Path::above_bound:
        return AssignmentStatus::above_bound;
      case Path::none:
        return AssignmentStatus::infeasible;
    }
  }
  if (!place_spare_rows(spare_share, bound)) return AssignmentStatus::above_bound;
  cost_ = sum_of_costs();
  return cost_ < bound ? AssignmentStatus::optimal : AssignmentStatus::above_bound;
}

double AssignmentSolver::sum_of_costs() const {
  double sum = 0.0;
  for (int i = 0; i < rows_; ++i) sum += row(i)[column_of_row_[at(i)]];
  return sum;
}

// False if a row is left with forbidden pairs only.
bool AssignmentSolver::take_free_columns(std::span<const int> rows) {
  for (const int i : rows) {
    ++rows_scanned_;
    int cheapest = -1;
    for (int j = 0; j < columns_; ++j) {
      if (row_of_column_[at(j)] >= 0) continue;
      if (cheapest < 0 || row(i)[j] < row(i)[cheapest]) cheapest = j;
    }
    if (!(row(i)[cheapest] < infinity)) return false;
    row_of_column_[at(cheapest)] = i;
    column_of_row_[at(i)] = cheapest;
  }
  return true;
}

// Columns left over must be the dearest, else an assignment that takes them instead is cheaper.
bool AssignmentSolver::place_spare_rows(double share, double bound) {
  const auto is_free = [this](int j) { return row_of_column_[at(j)] < 0; };
  const auto leave_dearest = [&](double highest) {
    int misplaced = 0;
    for (int j = 0; j < columns_; ++j) misplaced += is_free(j) && price_[at(j)] < highest;
    return misplaced == 0;
  };
  if (leave_dearest(highest_price())) return true;

  for (int i = rows_; i < columns_; ++i) {
    if (at(i) % steps_unchecked == steps_unchecked - 1) check_interruption();
    const double highest = highest_price();
    int column = 0;
    while (column < columns_ && !(is_free(column) && price_[at(column)] == highest)) ++column;
    if (column < columns_) {
      row_of_column_[at(column)] = i;
    } else if (augment(i, bound_below_ - share, bound) == Path::above_bound) {
      return false;
    }
  }
  return true;
}

Eigen::Map<const Eigen::ArrayXd> AssignmentSolver::row_array(int i) const {
  return {row(i), columns_};
}

const double* AssignmentSolver::row(int i) const {
  return i < rows_ ? costs_ + at(i) * at(columns_) : zeros_.data();
}

double AssignmentSolver::highest_price() const {
  return price_.empty() ? 0.0 : *std::max_element(price_.begin(), price_.end());
}

double AssignmentSolver::price_sum() const {
  const double sum = std::accumulate(price_.begin(), price_.end(), 0.0);
  return rows_ == columns_ ? sum : sum - (columns_ - rows_) * highest_price();
}

// Each row takes its cheapest column if that is still free; the others are left pending.
AssignmentStatus AssignmentSolver::take_row_minima() {
  std::fill(row_of_column_.begin(), row_of_column_.end(), -1);
  pending_.clear();
  rows_scanned_ += rows_;
  bound_below_ = price_sum();
  bool sound = true;
  const Eigen::Map<const Eigen::ArrayXd> price(price_.data(), columns_);
  Eigen::Map<Eigen::ArrayXd> reduced(shortest_.data(), columns_);
  for (int i = 0; i < rows_; ++i) {
    reduced = row_array(i) - price;
    const double least = reduced.minCoeff<Eigen::PropagateNaN>();
    if (!(least > -infinity)) sound = false;
    int column = -1;
    if (least < infinity) {
      column = 0;
      while (reduced[column] != least) ++column;
    }
    share_[at(i)] = least;
    bound_below_ += least;
    column_of_row_[at(i)] = -1;
    if (column >= 0 && row_of_column_[at(column)] < 0) {
      row_of_column_[at(column)] = i;
      column_of_row_[at(i)] = column;
    } else {
      pending_.push_back(i);
    }
  }
  if (!sound) return AssignmentStatus::bad_input;
  return bound_below_ == infinity ? AssignmentStatus::infeasible : AssignmentStatus::optimal;
}

// The cheapest way to give `start` a column, moving other rows along (Dijkstra on reduced costs).
// `rest` is the dual bound without the start row; its share is the length of the path.
AssignmentSolver::Path AssignmentSolver::augment(int start, double rest, double bound) {
  // Scanned columns get the price of -infinity here: no way leads to them again.
  std::copy(price_.begin(), price_.end(), open_price_.begin());
  const Eigen::Map<const Eigen::ArrayXd> open_price(open_price_.data(), columns_);
  Eigen::Map<Eigen::ArrayXd> shortest(shortest_.data(), columns_);
  shortest.setConstant(infinity);
  steps_.clear();
  steps_.push_back({start, -1, 0.0, 0.0});
  for (;;) {
    const Step& last = steps_.back();
    if (steps_.size() % steps_unchecked == 0) check_interruption();
    ++rows_scanned_;
    shortest = shortest.min(row_array(last.row) - open_price - last.offset);
    const double length = shortest.minCoeff();
    if (length == infinity) return Path::none;
    if (rest + length >= bound) return Path::above_bound;
    int column = 0;
    while (shortest_[at(column)] != length) ++column;
    const int owner = row_of_column_[at(column)];
    if (owner < 0) {
      flip_path(column, length);
      for (const Step& step : steps_) {
        if (step.column >= 0) price_[at(step.column)] += step.distance - length;
      }
      bound_below_ = rest + length;
      return Path::found;
    }
    shortest_[at(column)] = infinity;
    open_price_[at(column)] = -infinity;
    steps_.push_back({owner, column, length, row(owner)[column] - price_[at(column)] - length});
  }
}

// The row that led to a column was not noted on the way, which keeps the loop above free of
// branches; it is the first row that gives the same distance again.
void AssignmentSolver::flip_path(int column, double distance) {
  for (;;) {
    const double price = price_[at(column)];
    const auto from = std::find_if(steps_.begin(), steps_.end(), [&](const Step& step) {
      return row(step.row)[column] - price - step.offset == distance;
    });
    row_of_column_[at(column)] = from->row;
    if (from->row < rows_) column_of_row_[at(from->row)] = column;
    if (from->column < 0) return;
    column = from->column;
    distance = from->distance;
  }
}

}  // namespace shoal::solvers
