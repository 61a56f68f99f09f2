#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

// Rypkema 2015, eq. 3.4-3.7 with two neighbours.
struct TwoNeighbours {
  template <class T>
  T operator()(const T* p) const {
    using std::sqrt;
    const double s = 300.0, weight = 1e-5;
    T cost(0.0);
    T x_sum(0.0), y_sum(0.0);
    for (const Vector2d& n : {Vector2d(-280, -81), Vector2d(-25, -193)}) {
      const T dx = p[0] - T(n.x()), dy = p[1] - T(n.y());
      const T r2 = dx * dx + dy * dy;
      cost = cost + T(0.5 * s * s * s) / r2 + sqrt(r2) - T(3.0 * s);
      x_sum = x_sum + T(0.5 * n.x());
      y_sum = y_sum + T(0.5 * n.y());
    }
    const T dx = p[0] - x_sum, dy = p[1] - y_sum;
    return cost + T(weight) * (dx * dx + dy * dy);
  }
};

struct Bowl {
  Vector2d lowest{3.0, -2.0};
  template <class T>
  T operator()(const T* p) const {
    const T dx = p[0] - T(lowest.x()), dy = p[1] - T(lowest.y());
    return dx * dx + T(2.0) * dy * dy;
  }
};

// NaN where x > 1, on the way from (0, 0) to the lowest point.
struct BowlBehindABand : Bowl {
  template <class T>
  T operator()(const T* p) const {
    const T cost = Bowl::operator()(p);
    return p[0] > T(1.0) ? cost * T(nan_value) : cost;
  }
};

struct Nowhere {
  template <class T>
  T operator()(const T* p) const {
    return p[0] * T(nan_value);
  }
};

struct MyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ThrowsAway : Bowl {
  template <class T>
  T operator()(const T* p) const {
    if (p[0] > T(0.5)) throw MyError("no cost east of 0.5");
    return Bowl::operator()(p);
  }
};

class Line final : public Objective {
 public:
  double evaluate(const double* x, double* gradient, double* hessian) const override {
    if (gradient) gradient[0] = 2.0 * (x[0] - 1.0);
    if (hessian) hessian[0] = 2.0;
    return (x[0] - 1.0) * (x[0] - 1.0);
  }
  std::pair<Objective*, bool> copy_into(void*, std::size_t) const override {
    return {new Line, true};
  }
};

// A cost whose gradient has the wrong sign: a mistake that must not end as "converged".
class WrongSign final : public Objective {
 public:
  double evaluate(const double* x, double* gradient, double* hessian) const override {
    if (gradient) Eigen::Map<Vector2d>{gradient} = Vector2d(-2.0 * x[0], -2.0 * x[1]);
    if (hessian) Eigen::Map<Eigen::Matrix2d>{hessian} = -2.0 * Eigen::Matrix2d::Identity();
    return x[0] * x[0] + x[1] * x[1];
  }
  std::pair<Objective*, bool> copy_into(void*, std::size_t) const override {
    return {new WrongSign, true};
  }
};

const std::vector<std::string> names{
    "nlopt.lbfgs", "nlopt.slsqp",  "nlopt.mma",        "nlopt.ccsaq", "nlopt.tnewton",
    "nlopt.var2",  "nlopt.bobyqa", "nlopt.neldermead", "nlopt.sbplx", "nlopt.praxis"};
const std::vector<std::string> with_gradient(names.begin(), names.begin() + 6);

std::unique_ptr<Solver> solver(const std::string& name, std::int64_t max_evaluations = 500) {
  Setting setting;
  setting.at_or_new("max_evaluations").value = max_evaluations;
  return Registry<Solver>::instance().make(name, setting, "solver." + name);
}

template <class Cost>
Problem problem_of(const Cost& cost, const Vector2d& start = {0, 0}) {
  return Problem(start, differentiated<2>(cost));
}

TEST(Nlopt, FindsTheMinimumOfTheThesisCostWithEveryAlgorithm) {
  for (const std::string& name : names) {
    const Solution solution = solver(name)->solve(problem_of(TwoNeighbours{}));
    EXPECT_EQ(name_of(solution.status), "converged") << name << ": " << solution.backend_says;
    EXPECT_NEAR((Vector2d(solution.x) - Vector2d(-45.7795, 105.9797)).norm(), 0.0, 5e-3) << name;
    EXPECT_NEAR(solution.cost, -899.294820, 1e-6) << name;
    EXPECT_GT(solution.evaluations, 1) << name;
    EXPECT_LE(solution.evaluations, 500) << name;
  }
}

TEST(Nlopt, StopsAtNanAndKeepsTheBestFinitePoint) {
  for (const std::string& name : names) {
    const Solution solution = solver(name)->solve(problem_of(BowlBehindABand{}));
    EXPECT_EQ(name_of(solution.status), "diverged") << name;
    EXPECT_TRUE(solution.x.allFinite()) << name;
    EXPECT_LE(solution.x[0], 1.0) << name;
    EXPECT_EQ(solution.cost, Bowl{}(solution.x.data())) << name;
    EXPECT_FALSE(solution.usable()) << name;
  }
}

TEST(Nlopt, HasNoPointWhereThereIsNoFiniteCost) {
  for (const std::string& name : names) {
    const Solution solution = solver(name)->solve(problem_of(Nowhere{}));
    EXPECT_EQ(name_of(solution.status), "diverged") << name;
    EXPECT_TRUE(std::isnan(solution.cost)) << name;
    EXPECT_TRUE(std::isnan(solution.x[0])) << name;
    EXPECT_EQ(solution.evaluations, 1) << name;
  }
}

TEST(Nlopt, LetsTheExceptionOfTheCostThroughUnchanged) {
  for (const std::string& name : names) {
    try {
      solver(name)->solve(problem_of(ThrowsAway{}));
      ADD_FAILURE() << name << " swallowed the exception";
    } catch (const MyError& error) {
      EXPECT_STREQ(error.what(), "no cost east of 0.5") << name;
    }
  }
}

TEST(Nlopt, RefusesAStartOrBoundsThatMakeNoSense) {
  const auto refused = [](const Problem& problem) {
    for (const std::string& name : names) {
      const Solution solution = solver(name)->solve(problem);
      EXPECT_EQ(name_of(solution.status), "bad_input") << name;
      EXPECT_EQ(solution.evaluations, 0) << name;
      EXPECT_STRNE(solution.backend_says, "") << name;
      EXPECT_TRUE(solution.x.size() == 0 || std::isnan(solution.x[0])) << name;
    }
  };
  refused(problem_of(Bowl{}, {nan_value, 0}));
  refused(problem_of(Bowl{}, {0, std::numeric_limits<double>::infinity()}));
  refused(Problem(Problem::Vector(0), differentiated<2>(Bowl{})));
  Problem problem = problem_of(Bowl{});
  problem.lower = Vector2d(-1, -1);
  refused(problem);  // half the bounds
  problem.upper = Eigen::Vector3d(1, 1, 1);
  refused(problem);  // wrong size
  problem.upper = Vector2d(1, -2);
  refused(problem);  // crossed
  problem.upper = Vector2d(1, nan_value);
  refused(problem);
  problem.upper = Vector2d(1, -0.5);
  refused(problem);  // start outside
}

TEST(Nlopt, StaysInsideTheBounds) {
  for (const std::string& name : names) {
    Problem problem = problem_of(Bowl{});
    problem.lower = Vector2d(-1, -1);
    problem.upper = Vector2d(1, 1);
    const Solution solution = solver(name)->solve(problem);
    EXPECT_TRUE(solution.usable()) << name << ": " << name_of(solution.status);
    EXPECT_NEAR((Vector2d(solution.x) - Vector2d(1, -1)).norm(), 0.0, 1e-3) << name;
    EXPECT_LE(solution.x[0], 1.0) << name;
    EXPECT_GE(solution.x[1], -1.0) << name;
  }
}

TEST(Nlopt, LeavesAnUnknownAloneWhoseBoundsAreEqual) {
  for (const std::string& name : names) {
    Problem problem = problem_of(Bowl{}, {0, 0.5});
    problem.lower = Vector2d(-10, 0.5);
    problem.upper = Vector2d(10, 0.5);
    const Solution solution = solver(name)->solve(problem);
    if (name == "nlopt.bobyqa") {
      EXPECT_EQ(name_of(solution.status), "bad_input") << "BOBYQA needs two unknowns";
      continue;
    }
    EXPECT_TRUE(solution.usable()) << name << ": " << solution.backend_says;
    EXPECT_NEAR(solution.x[0], 3.0, 1e-3) << name;
    EXPECT_EQ(solution.x[1], 0.5) << name;
  }
}

TEST(Nlopt, AnswersWithTheStartWhenEverythingIsFixed) {
  Problem problem = problem_of(Bowl{}, {1, 1});
  problem.lower = Vector2d(1, 1);
  problem.upper = Vector2d(1, 1);
  for (const std::string& name : names) {
    const Solution solution = solver(name)->solve(problem);
    EXPECT_EQ(name_of(solution.status), "converged") << name;
    EXPECT_EQ(Vector2d(solution.x), Vector2d(1, 1)) << name;
    EXPECT_EQ(solution.cost, 22.0) << name;
  }
}

TEST(Nlopt, KeepsToItsBudgetAndNeverEndsWorseThanItStarted) {
  const Problem problem = problem_of(TwoNeighbours{});
  const double at_start = problem.evaluate(problem.start.data());
  for (const std::string& name : names) {
    for (const int budget : {1, 2, 3, 7}) {
      const Solution solution = solver(name, budget)->solve(problem);
      EXPECT_EQ(name_of(solution.status), "budget") << name << " with " << budget;
      EXPECT_LE(solution.evaluations, budget) << name;
      EXPECT_LE(solution.cost, at_start) << name;
      EXPECT_TRUE(solution.x.allFinite()) << name;
    }
  }
}

TEST(Nlopt, RefusesABudgetOfNothingAndAnyUnknownOption) {
  EXPECT_THROW(solver("nlopt.lbfgs", 0), InputError);
  EXPECT_THROW(solver("nlopt.lbfgs", -5), InputError);
  EXPECT_THROW(solver("nlopt.lbgfs"), InputError);
}

TEST(Nlopt, DoesNotCallAWrongGradientConverged) {
  for (const std::string& name : with_gradient) {
    const Solution solution = solver(name)->solve(Problem(Vector2d(5, 5), WrongSign{}));
    EXPECT_NE(name_of(solution.status), "converged") << name << ": " << solution.backend_says;
    EXPECT_LE(solution.cost, 50.0) << name;
  }
}

TEST(Nlopt, SolvesProblemsOfOneUnknownOrSaysWhyNot) {
  const Problem problem(Eigen::Matrix<double, 1, 1>(0.0), Line{});
  for (const std::string& name : names) {
    const auto one = solver(name);
    const auto why_not = one->refuses(problem);
    EXPECT_EQ(why_not.has_value(), name == "nlopt.bobyqa") << name;
    const Solution solution = one->solve(problem);
    if (why_not) {
      EXPECT_EQ(name_of(solution.status), "bad_input");
    } else {
      EXPECT_TRUE(solution.usable()) << name << ": " << solution.backend_says;
      EXPECT_NEAR(solution.x[0], 1.0, 1e-3) << name;
    }
  }
}

TEST(Nlopt, StaysWhereItIsWhenItStartsAtTheMinimum) {
  for (const std::string& name : names) {
    const Solution solution = solver(name)->solve(problem_of(Bowl{}, {3, -2}));
    EXPECT_TRUE(solution.usable()) << name << ": " << solution.backend_says;
    EXPECT_NEAR(solution.cost, 0.0, 1e-9) << name;
  }
}

TEST(Nlopt, GivesTheSameBitsAgainAndInAnotherThread) {
  for (const std::string& name : names) {
    const auto one = solver(name);
    const Problem problem = problem_of(TwoNeighbours{});
    const Solution here = one->solve(problem);
    const Solution again = one->solve(problem);
    Solution there;
    std::thread([&] { there = one->solve(problem); }).join();
    EXPECT_EQ(Vector2d(here.x), Vector2d(again.x)) << name;
    EXPECT_EQ(Vector2d(here.x), Vector2d(there.x)) << name;
    EXPECT_EQ(here.evaluations, there.evaluations) << name;
  }
}

}  // namespace
}  // namespace shoal::solvers
