#include "shoal/solvers/matching/assignment.hpp"

#include <dlib/optimization/max_cost_assignment.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

struct Matrix {
  int rows = 0, columns = 0;
  std::vector<double> costs;

  double at(int i, int j) const { return costs[static_cast<std::size_t>(i * columns + j)]; }
};

// All permutations of the columns, the first `rows` of which are used.
double least_by_trying_all(const Matrix& m) {
  std::vector<int> columns(static_cast<std::size_t>(m.columns));
  std::iota(columns.begin(), columns.end(), 0);
  double least = infinity;
  do {
    double sum = 0.0;
    for (int i = 0; i < m.rows; ++i) sum += m.at(i, columns[static_cast<std::size_t>(i)]);
    least = std::min(least, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

// Few values make ties, `forbidden` makes some of them infinite, `real` makes none equal.
Matrix any_matrix(bool real, bool forbidden) {
  Matrix m;
  m.rows = *rc::gen::inRange(1, 7);
  m.columns = *rc::gen::inRange(m.rows, 7);
  for (int k = 0; k < m.rows * m.columns; ++k) {
    const bool out = forbidden && *rc::gen::inRange(0, 3) == 0;
    m.costs.push_back(out    ? infinity
                      : real ? *rc::gen::inRange(-1000, 1'000'000) * 1e-3
                             : *rc::gen::inRange(-2, 6));
  }
  return m;
}

double sum_of(const AssignmentSolver& solver, const Matrix& m) {
  std::vector<bool> taken(static_cast<std::size_t>(m.columns));
  double sum = 0.0;
  for (int i = 0; i < m.rows; ++i) {
    const int j = solver.column_of()[static_cast<std::size_t>(i)];
    RC_ASSERT(j >= 0);
    RC_ASSERT(j < m.columns);
    RC_ASSERT(!taken[static_cast<std::size_t>(j)]);
    taken[static_cast<std::size_t>(j)] = true;
    sum += m.at(i, j);
  }
  return sum;
}

void expect_least(AssignmentStatus status, const AssignmentSolver& solver, const Matrix& m) {
  const double least = least_by_trying_all(m);
  if (least == infinity) {
    RC_ASSERT(status == AssignmentStatus::infeasible);
    return;
  }
  RC_ASSERT(status == AssignmentStatus::optimal);
  RC_ASSERT(std::abs(solver.cost() - least) < 1e-9);
  RC_ASSERT(std::abs(sum_of(solver, m) - least) < 1e-9);
}

TEST(Assignment, IsAsCheapAsTheBestOfAllPermutations) {
  for (const bool real : {false, true}) {
    for (const bool forbidden : {false, true}) {
      EXPECT_TRUE(rc::check("agrees with brute force", [=] {
        const Matrix m = any_matrix(real, forbidden);
        AssignmentSolver solver;
        expect_least(solver.solve(m.costs, m.rows, m.columns), solver, m);
      }));
    }
  }
}

TEST(Assignment, IsAsCheapWhenItStartsFromThePricesOfAnotherMatrix) {
  for (const bool forbidden : {false, true}) {
    EXPECT_TRUE(rc::check("warm starts are exact", [=] {
      const Matrix m = any_matrix(true, forbidden);
      AssignmentSolver solver;
      solver.reset(m.rows, m.columns);
      for (int before = 0; before < 3; ++before) {
        std::vector<double> other = m.costs;
        for (double& c : other) c += *rc::gen::inRange(0, 500);
        solver.solve_similar(other, *rc::gen::inRange(0, 3000));
      }
      expect_least(solver.solve_similar(m.costs), solver, m);
    }));
  }
}

TEST(Assignment, AbandonsExactlyThoseThatCannotBeatTheBound) {
  EXPECT_TRUE(rc::check("the bound cuts at the optimum", [] {
    const Matrix m = any_matrix(true, false);
    const double least = least_by_trying_all(m);
    AssignmentSolver solver;
    RC_ASSERT(solver.solve(m.costs, m.rows, m.columns, least + 1e-6) == AssignmentStatus::optimal);
    RC_ASSERT(std::abs(solver.cost() - least) < 1e-9);
    RC_ASSERT(solver.solve(m.costs, m.rows, m.columns, least - 1e-6) ==
              AssignmentStatus::above_bound);
  }));
}

TEST(Assignment, IsCompleteWhereTheRowsToBeScannedRunOut) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> cost(0.0, 1.0);
  AssignmentSolver solver;
  for (int trial = 0; trial < 20; ++trial) {
    const int rows = 30, columns = 30 + trial % 3;
    std::vector<double> costs;
    for (int k = 0; k < rows * columns; ++k) costs.push_back(cost(generator));
    ASSERT_EQ(solver.solve(costs, rows, columns), AssignmentStatus::optimal);
    const double least = solver.cost();
    double before = 0.0;
    for (const std::int64_t most_rows : {0, 5, 40, 100'000}) {
      const auto status =
          solver.solve(costs, rows, columns, AssignmentSolver::unbounded, most_rows);
      EXPECT_TRUE(status == AssignmentStatus::budget || most_rows > 0);
      EXPECT_TRUE(status == AssignmentStatus::optimal || most_rows < 100'000);
      EXPECT_GE(solver.cost(), least - 1e-12);
      const std::set<int> taken(solver.column_of().begin(), solver.column_of().end());
      EXPECT_EQ(taken.size(), static_cast<std::size_t>(rows)) << "no column is taken twice";
      before = solver.cost();
    }
    EXPECT_EQ(before, least);
  }
  const double none = AssignmentSolver::unbounded;
  const std::vector<double> forbidden{1.0, none, 2.0, none};
  EXPECT_EQ(solver.solve(forbidden, 2, 2, none, 0), AssignmentStatus::infeasible);
}

TEST(Assignment, PricesBoundEveryOtherMatrixFromBelow) {
  EXPECT_TRUE(rc::check("prices are dual feasible", [] {
    const Matrix m = any_matrix(true, false);
    AssignmentSolver solver;
    solver.solve(m.costs, m.rows, m.columns);
    Matrix other = m;
    for (double& c : other.costs) c += *rc::gen::inRange(-300, 300);
    double bound = solver.price_sum();
    for (int i = 0; i < m.rows; ++i) {
      double least = infinity;
      for (int j = 0; j < m.columns; ++j) {
        least = std::min(least, other.at(i, j) - solver.prices()[static_cast<std::size_t>(j)]);
      }
      bound += least;
    }
    RC_ASSERT(bound <= least_by_trying_all(other) + 1e-9);
  }));
}

TEST(Assignment, AgreesWithDlibOnWholeNumbers) {
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> cost(0, 1000);
  AssignmentSolver solver;
  for (int n = 20; n <= 50; n += 3) {
    dlib::matrix<int> gain(n, n);
    std::vector<double> costs;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        gain(i, j) = -cost(generator);
        costs.push_back(-gain(i, j));
      }
    }
    const std::vector<long> best = dlib::max_cost_assignment(gain);
    ASSERT_EQ(solver.solve(costs, n, n), AssignmentStatus::optimal);
    EXPECT_EQ(solver.cost(), -dlib::assignment_cost(gain, best)) << n << " rows";
  }
}

TEST(Assignment, GivesEqualChoicesToTheLowestColumn) {
  AssignmentSolver solver;
  const std::vector<double> equal(12, 5.0);
  ASSERT_EQ(solver.solve(equal, 3, 4), AssignmentStatus::optimal);
  EXPECT_EQ(std::vector<int>(solver.column_of().begin(), solver.column_of().end()),
            (std::vector<int>{0, 1, 2}));
}

TEST(Assignment, SaysWhenTheForbiddenPairsLeaveNoWay) {
  AssignmentSolver solver;
  EXPECT_EQ(solver.solve(std::vector{1.0, infinity, 2.0, infinity}, 2, 2),
            AssignmentStatus::infeasible);
  EXPECT_EQ(solver.solve(std::vector{1.0, 2.0, infinity, infinity}, 2, 2),
            AssignmentStatus::infeasible);
}

TEST(Assignment, RefusesNanMinusInfinityAndWrongShapes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  AssignmentSolver solver;
  for (std::size_t place = 0; place < 6; ++place) {
    std::vector<double> costs{1.0, infinity, 3.0, 4.0, 5.0, 6.0};
    costs[place] = nan;
    EXPECT_EQ(solver.solve(costs, 2, 3), AssignmentStatus::bad_input) << place;
    costs[place] = -infinity;
    EXPECT_EQ(solver.solve(costs, 2, 3), AssignmentStatus::bad_input) << place;
  }
  EXPECT_EQ(solver.solve(std::vector(6, 1.0), 3, 2), AssignmentStatus::bad_input);
  EXPECT_EQ(solver.solve(std::vector(5, 1.0), 2, 3), AssignmentStatus::bad_input);
  EXPECT_EQ(solver.solve(std::vector(6, 1.0), 2, 3), AssignmentStatus::optimal);
}

TEST(Assignment, OfNoPointsCostsNothing) {
  AssignmentSolver solver;
  EXPECT_EQ(solver.solve({}, 0, 0), AssignmentStatus::optimal);
  EXPECT_EQ(solver.cost(), 0.0);
}

}  // namespace
}  // namespace shoal::solvers
