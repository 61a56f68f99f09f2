// Problems of more unknowns than are held in place: the layout of a whole swarm.

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/smooth/attempt.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

TEST(Unknowns, AreHeldInPlaceIfTheyAreFew) {
  const std::size_t before = shoal::tests::allocations();
  Unknowns few = Eigen::Vector3d(1, 2, 3);
  Unknowns copy = few;
  copy[1] = 7;
  few = 2.0 * few - copy;
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
  EXPECT_EQ(few, Eigen::Vector3d(1, -3, 3));
}

TEST(Unknowns, KeepTheirElementsWhateverTheirNumber) {
  for (const int n : {0, 1, 6, 7, 500}) {
    const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0);
    Unknowns one = numbers;
    Unknowns copy(one), moved(std::move(copy));
    EXPECT_EQ(one, numbers);
    EXPECT_EQ(moved, numbers);
    Unknowns other(3);
    other = one;
    EXPECT_EQ(other, numbers);
    other = Unknowns(Eigen::Vector2d(4, 5));
    EXPECT_EQ(other, Eigen::Vector2d(4, 5));
    other = std::move(one);
    EXPECT_EQ(other, numbers);
    const Unknowns& same = other;
    other = same;
    EXPECT_EQ(other, numbers);
  }
}

/// How far distances between vehicles are from those of their slots, and vehicles from where they
/// were heard. Unknowns: all places, east and north in turn (m); a block depends on those of one or
/// two vehicles.
class Layout final : public VectorFunction {
 public:
  explicit Layout(std::vector<Vector2d> slots, std::vector<Vector2d> heard)
      : slots_(std::move(slots)), heard_(std::move(heard)) {
    for (int i = 0; i < vehicles(); ++i) {
      for (int j = 0; j < i; ++j) {
        if ((slot(i) - slot(j)).norm() < 450.0) pairs_.emplace_back(i, j);
      }
    }
    for (const auto& [i, j] : pairs_) unknowns_.push_back({2 * j, 2 * j + 1, 2 * i, 2 * i + 1});
    for (int i = 0; i < vehicles(); ++i) unknowns_.push_back({2 * i, 2 * i + 1});
  }

  int vehicles() const { return static_cast<int>(slots_.size()); }
  int pairs() const { return static_cast<int>(pairs_.size()); }
  int blocks() const override { return pairs() + vehicles(); }
  int block_size() const override { return 2; }
  std::span<const int> unknowns_of(int block) const override {
    return unknowns_[static_cast<std::size_t>(block)];
  }

  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    const int n = block < pairs() ? 4 : 2;
    if (jacobian) std::fill_n(jacobian, 2 * n, 0.0);
    if (hessians) std::fill_n(hessians, 2 * n * n, 0.0);
    values[1] = 0.0;
    if (block >= pairs()) {
      const int i = block - pairs();
      for (int k = 0; k < 2; ++k) {
        values[k] = 0.01 * (x[2 * i + k] - heard_[static_cast<std::size_t>(i)][k]);
        if (jacobian) jacobian[k * n + k] = 0.01;
      }
      return;
    }
    const auto [i, j] = pairs_[static_cast<std::size_t>(block)];
    const Vector2d away(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]);
    const double r = away.norm();
    values[0] = r - (slot(i) - slot(j)).norm();
    const Vector2d direction = away / r;
    const Eigen::Matrix2d bend =
        (Eigen::Matrix2d::Identity() - direction * direction.transpose()) / r;
    for (int a = 0; a < 2; ++a) {
      if (jacobian) {
        jacobian[2 + a] = direction[a];
        jacobian[a] = -direction[a];
      }
      for (int b = 0; hessians && b < 2; ++b) {
        hessians[(2 + a) * n + 2 + b] += bend(a, b);
        hessians[a * n + b] += bend(a, b);
        hessians[(2 + a) * n + b] -= bend(a, b);
        hessians[a * n + 2 + b] -= bend(a, b);
      }
    }
  }

 private:
  const Vector2d& slot(int i) const { return slots_[static_cast<std::size_t>(i)]; }

  std::vector<Vector2d> slots_, heard_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<std::vector<int>> unknowns_;
};

/// The same function, without saying on which unknowns a block depends.
class Dense final : public VectorFunction {
 public:
  Dense(std::shared_ptr<const VectorFunction> function, int dimension)
      : function_(std::move(function)), dimension_(dimension) {}

  int blocks() const override { return function_->blocks(); }
  int block_size() const override { return function_->block_size(); }
  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    evaluate_by_all(*function_, block, dimension_, x, values, jacobian, hessians);
  }

 private:
  std::shared_ptr<const VectorFunction> function_;
  int dimension_;
};

/// A lattice of 10 x 5 vehicles, heard with an error of 20 m: 100 unknowns.
Problem layout(std::shared_ptr<const Layout>& residuals) {
  std::mt19937 generator(3);
  std::normal_distribution<double> error(0.0, 20.0);
  std::vector<Vector2d> slots, heard;
  for (int i = 0; i < 50; ++i) {
    slots.emplace_back(300.0 * (i % 10), 300.0 * (i / 10));
    heard.emplace_back(slots.back().x() + error(generator), slots.back().y() + error(generator));
  }
  Eigen::VectorXd start(100);
  for (int i = 0; i < 50; ++i) start.segment<2>(2 * i) = heard[static_cast<std::size_t>(i)];
  residuals = std::make_shared<const Layout>(slots, heard);
  return least_squares_problem(start, {residuals, nullptr, {}});
}

Solution solved(const std::string& name, const Problem& problem) {
  Setting options;
  options.at_or_new("max_evaluations").value = std::int64_t{5000};
  const auto solver = Registry<Solver>::instance().make(name, options, "solver");
  EXPECT_EQ(solver->refuses(problem), std::nullopt);
  return solver->solve(problem);
}

class ManyUnknowns : public testing::TestWithParam<std::string> {
 protected:
  void expect_the_minimum(const Solution& solution, const Problem& problem) {
    EXPECT_EQ(solution.status, Status::converged) << name_of(solution.status);
    const Solution exact = solved("newton", problem);
    ASSERT_EQ(exact.status, Status::converged);
    ASSERT_EQ(solution.x.size(), exact.x.size());
    EXPECT_LT((solution.x - exact.x).lpNorm<Eigen::Infinity>(), 1e-4);
  }
};

TEST_P(ManyUnknowns, LayOutAWholeSwarm) {
  std::shared_ptr<const Layout> residuals;
  const Problem problem = layout(residuals);
  const Solution solution = solved(GetParam(), problem);
  expect_the_minimum(solution, problem);
  EXPECT_LT(solution.cost, 0.05 * problem.evaluate(problem.start.data()));
  // Distances are those of the lattice within 0.5 m.
  for (int b = 0; b < residuals->pairs(); ++b) {
    double miss[2];
    residuals->evaluate(b, solution.x.data(), miss, nullptr, nullptr);
    EXPECT_LT(std::abs(miss[0]), 0.5) << b;
  }
}

TEST(Sparsity, ChangesNeitherTheCostNorItsDerivatives) {
  std::shared_ptr<const Layout> residuals;
  const Problem sparse = layout(residuals);
  const Problem dense = least_squares_problem(
      sparse.start, {std::make_shared<const Dense>(residuals, 100), nullptr, {}});
  std::mt19937 generator(5);
  std::normal_distribution<double> shift(0.0, 30.0);
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd x = sparse.start, gradient(100), other_gradient(100);
    for (double& each : x) each += shift(generator);
    Eigen::MatrixXd hessian(100, 100), other_hessian(100, 100);
    const double cost = sparse.evaluate(x.data(), gradient.data(), hessian.data());
    const double other = dense.evaluate(x.data(), other_gradient.data(), other_hessian.data());
    EXPECT_NEAR(cost, other, 1e-12 * other);
    EXPECT_LT((gradient - other_gradient).norm(), 1e-12 * gradient.norm());
    EXPECT_LT((hessian - other_hessian).norm(), 1e-12 * hessian.norm());
    EXPECT_EQ(sparse.evaluate(x.data(), gradient.data()), cost);
    EXPECT_LT((gradient - other_gradient).norm(), 1e-12 * gradient.norm());
  }
}

TEST(Sparsity, OfTheHessianIsWhatBackendsSee) {
  std::shared_ptr<const Layout> residuals;
  Problem problem = layout(residuals);
  problem.lower = problem.start.array() - 30.0;
  problem.upper = problem.start.array() + 30.0;
  (*problem.lower)[3] = (*problem.upper)[3] = problem.start[3];  // one unknown is fixed
  Attempt attempt(problem, {});
  const int n = attempt.unknowns();
  ASSERT_EQ(n, 99);
  Eigen::MatrixXd hessian(n, n);
  Eigen::VectorXd gradient(n), at = attempt.start();
  double cost = 0.0;
  ASSERT_EQ(attempt.evaluate(at.data(), cost, gradient.data(), hessian.data()),
            Attempt::Outcome::fine);
  std::size_t not_zero = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) not_zero += hessian(i, j) != 0.0 ? 1 : 0;
  }
  const auto pattern = attempt.hessian_pattern();
  EXPECT_EQ(pattern.size(), not_zero);
  EXPECT_LT(pattern.size(), 1500u) << "of 4950: a vehicle has eight neighbours at most";
  for (const auto& [i, j] : pattern) EXPECT_NE(hessian(i, j), 0.0) << i << ", " << j;
  EXPECT_EQ(attempt.unknowns_of_residuals(residuals->pairs() + 1), std::vector<int>{2});
}

TEST_P(ManyUnknowns, AreTheSameWhetherOrNotTheFunctionSaysOnWhichItDepends) {
  std::shared_ptr<const Layout> residuals;
  const Problem problem = layout(residuals);
  expect_the_minimum(
      solved(GetParam(),
             least_squares_problem(problem.start,
                                   {std::make_shared<const Dense>(residuals, 100), nullptr, {}})),
      problem);
}

TEST_P(ManyUnknowns, KeepToBoundsThatHoldSomeOfThem) {
  if (GetParam() == "ceres.lbfgs") GTEST_SKIP() << "takes no bounds";
  std::shared_ptr<const Layout> residuals;
  Problem problem = layout(residuals);
  problem.lower = problem.start.array() - 30.0;
  problem.upper = problem.start.array() + 30.0;
  for (int k = 0; k < 4; ++k) (*problem.lower)[k] = (*problem.upper)[k] = problem.start[k];
  const Solution solution = solved(GetParam(), problem);
  if (GetParam() == "ceres.least_squares") {
    // Ceres shortens its steps until they fit into the bounds, and comes to rest on the way.
    EXPECT_EQ(solution.status, Status::stalled_at_roundoff);
  } else {
    expect_the_minimum(solution, problem);
  }
  EXPECT_EQ(solution.x.head(4), problem.start.head(4)) << "two vehicles stay where they are";
  EXPECT_EQ(solution.violation, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Solvers, ManyUnknowns,
                         testing::Values("newton", "ipopt", "ceres.least_squares", "ceres.lbfgs",
                                         "nlopt.slsqp", "nlopt.lbfgs"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

}  // namespace
}  // namespace shoal::solvers
