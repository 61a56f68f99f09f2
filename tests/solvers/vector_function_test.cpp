#include "shoal/solvers/vector_function.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::solvers {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(LinearFunction, IsARowOfCoefficientsLessANumber) {
  const MatrixXd A{{2.0, 0.0, -1.0}, {0.0, 3.0, 0.0}};
  const auto function = linear_function(A, Eigen::Vector2d(4.0, 6.0));
  ASSERT_EQ(function->blocks(), 2);
  EXPECT_TRUE(function->linear());
  EXPECT_EQ(std::vector<int>(function->unknowns_of(0).begin(), function->unknowns_of(0).end()),
            (std::vector<int>{0, 2}));
  const double x[] = {5.0, 2.5, 7.0};
  double value = 0.0, own[2];
  function->evaluate(0, x, &value, own, nullptr);
  EXPECT_EQ(value, 2.0 * 5.0 - 7.0 - 4.0);
  EXPECT_EQ(own[0], 2.0);
  EXPECT_EQ(own[1], -1.0);

  double all[3], hessian[9];
  std::fill_n(hessian, 9, 1.0);
  evaluate_by_all(*function, 1, 3, x, &value, all, hessian);
  EXPECT_EQ(value, 3.0 * 2.5 - 6.0);
  EXPECT_EQ(Eigen::Map<const Eigen::Vector3d>(all), Eigen::Vector3d(0.0, 3.0, 0.0));
  EXPECT_TRUE(Eigen::Map<const Eigen::Matrix3d>(hessian).isZero(0.0));
}

TEST(LinearFunction, RefusesWhatIsNone) {
  EXPECT_THROW(linear_function(MatrixXd::Ones(2, 3), VectorXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW(linear_function(MatrixXd::Zero(1, 3), VectorXd::Ones(1)), std::invalid_argument);
  EXPECT_THROW(linear_function(MatrixXd::Constant(1, 1, INFINITY), VectorXd::Ones(1)),
               std::invalid_argument);
}

/// Linear, and fails where it is asked for what is known to be zero.
class WithoutHessian final : public VectorFunction {
 public:
  explicit WithoutHessian(std::shared_ptr<const VectorFunction> function)
      : function_(std::move(function)) {}

  int blocks() const override { return function_->blocks(); }
  int block_size() const override { return 1; }
  bool linear() const override { return true; }
  std::span<const int> unknowns_of(int block) const override {
    return function_->unknowns_of(block);
  }
  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    if (hessians) throw std::logic_error("the Hessian of a linear function was asked for");
    function_->evaluate(block, x, values, jacobian, nullptr);
  }

 private:
  std::shared_ptr<const VectorFunction> function_;
};

/// Vehicles near where they were heard, 2 n unknowns: x - heard.
class Nearness final : public VectorFunction {
 public:
  explicit Nearness(VectorXd heard) : heard_(std::move(heard)) {
    for (int i = 0; i < heard_.size(); ++i) unknowns_.push_back(i);
  }
  int blocks() const override { return static_cast<int>(heard_.size()); }
  int block_size() const override { return 1; }
  bool linear() const override { return true; }
  std::span<const int> unknowns_of(int block) const override {
    return std::span(unknowns_).subspan(static_cast<std::size_t>(block), 1);
  }
  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    values[0] = x[block] - heard_[block];
    if (jacobian) jacobian[0] = 1.0;
    if (hessians) hessians[0] = 0.0;
  }

 private:
  VectorXd heard_;
  std::vector<int> unknowns_;
};

class LinearConstraints : public testing::TestWithParam<std::string> {
 protected:
  static constexpr int vehicles = 20;

  LinearConstraints() {
    for (int i = 0; i < 2 * vehicles; ++i) heard[i] = 100.0 * std::sin(3.0 * i) + 5.0 * i;
    // The swarm's centroid is held, and vehicles 0 and 1 keep the same northing.
    A = MatrixXd::Zero(3, 2 * vehicles);
    for (int i = 0; i < vehicles; ++i) A(0, 2 * i) = A(1, 2 * i + 1) = 1.0 / vehicles;
    A(2, 1) = 1.0;
    A(2, 3) = -1.0;
  }

  Problem problem() const {
    return least_squares_problem(heard, {std::make_shared<const Nearness>(heard), nullptr, {}});
  }
  Solution solved(const Problem& posed) const {
    const auto solver = Registry<Solver>::instance().make(GetParam(), {}, "solver");
    return solver->solve(posed);
  }

  VectorXd heard = VectorXd::Zero(2 * vehicles);
  MatrixXd A;
  VectorXd b = Eigen::Vector3d(40.0, 90.0, 0.0);
};

TEST_P(LinearConstraints, AsEqualitiesHoldTheNearestPointOfAPlane) {
  Problem posed = problem();
  posed.equalities = std::make_shared<const WithoutHessian>(linear_function(A, b));
  const Solution solution = solved(posed);
  EXPECT_EQ(solution.status, Status::converged) << name_of(solution.status);
  // The projection onto A x = b: x = heard - A^T (A A^T)^-1 (A heard - b).
  const VectorXd projected =
      heard - A.transpose() * (A * A.transpose()).inverse() * (A * heard - b);
  EXPECT_LT((solution.x - projected).lpNorm<Eigen::Infinity>(), 1e-4);
  EXPECT_LT(solution.violation, 1e-6);
}

TEST_P(LinearConstraints, AsInequalitiesBindOnlyWhereTheyAreBroken) {
  Problem posed = problem();
  // 1: vehicle 0 is 50 m further east than it was heard. 2: it may be anywhere north of -1e6 m.
  MatrixXd sides = MatrixXd::Zero(2, 2 * vehicles);
  sides(0, 0) = sides(1, 1) = 1.0;
  posed.constraints = std::make_shared<const WithoutHessian>(
      linear_function(sides, Eigen::Vector2d(heard[0] + 50.0, -1e6)));
  posed.start[0] += 100.0;
  const Solution solution = solved(posed);
  EXPECT_EQ(solution.status, Status::converged) << name_of(solution.status);
  VectorXd expected = heard;
  expected[0] += 50.0;
  EXPECT_LT((solution.x - expected).lpNorm<Eigen::Infinity>(), 1e-4);
}

TEST_P(LinearConstraints, MayConcernUnknownsThatAreFixed) {
  Problem posed = problem();
  posed.equalities = linear_function(A, b);
  posed.lower = VectorXd::Constant(2 * vehicles, -1e4);
  posed.upper = VectorXd::Constant(2 * vehicles, 1e4);
  (*posed.lower)[1] = (*posed.upper)[1] = heard[1];
  const Solution solution = solved(posed);
  EXPECT_EQ(solution.status, Status::converged) << name_of(solution.status);
  EXPECT_EQ(solution.x[1], heard[1]);
  EXPECT_NEAR(solution.x[3], heard[1], 1e-5);
  EXPECT_LT((A * solution.x - b).norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Solvers, LinearConstraints, testing::Values("ipopt", "nlopt.slsqp"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

}  // namespace
}  // namespace shoal::solvers
