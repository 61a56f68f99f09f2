#include "tests/solvers/problems.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::solvers {
namespace {

using tests::boxed;
using tests::known_problem;
using tests::known_problems;
using tests::KnownProblem;
using Vector = Problem::Vector;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd slope_of(const Problem& problem, const Vector& x) {
  VectorXd slope(x.size());
  problem.evaluate(x.data(), slope.data());
  return slope;
}

MatrixXd curvature_of(const Problem& problem, const Vector& x) {
  MatrixXd curvature(x.size(), x.size());
  problem.evaluate(x.data(), nullptr, curvature.data());
  return curvature;
}

struct Block {
  VectorXd values;
  MatrixXd jacobian;               // a row for each value
  std::vector<MatrixXd> hessians;  // one for each value
};

Block block_at(const VectorFunction& function, int block, const Vector& x) {
  const Eigen::Index m = function.block_size(), n = x.size();
  Block all{VectorXd(m), MatrixXd(m, n), {}};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(m, n);
  VectorXd hessians(m * n * n);
  function.evaluate(block, x.data(), all.values.data(), jacobian.data(), hessians.data());
  all.jacobian = jacobian;
  for (Eigen::Index k = 0; k < m; ++k) {
    all.hessians.emplace_back(Eigen::Map<const MatrixXd>(hessians.data() + k * n * n, n, n));
  }
  return all;
}

double least_constraint(const Problem& problem, const Vector& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int b = 0; problem.constraints && b < problem.constraints->blocks(); ++b) {
    least = std::min(least, block_at(*problem.constraints, b, x).values.minCoeff());
  }
  for (int b = 0; problem.equalities && b < problem.equalities->blocks(); ++b) {
    least = std::min(least, -block_at(*problem.equalities, b, x).values.cwiseAbs().maxCoeff());
  }
  return least;
}

Vector clamped(const Problem& problem, const Vector& x) {
  return problem.lower ? Vector(x.cwiseMax(*problem.lower).cwiseMin(*problem.upper)) : x;
}

/// Near x, where all equalities hold: shortest steps to the zeros of their linear models.
Vector onto_equalities(const Problem& problem, Vector x) {
  const int m = problem.equalities ? problem.equalities->blocks() : 0;
  for (int step = 0; m > 0 && step < 20; ++step) {
    VectorXd values(m);
    MatrixXd normals(m, x.size());
    for (int b = 0; b < m; ++b) {
      const Block block = block_at(*problem.equalities, b, x);
      values[b] = block.values[0];
      normals.row(b) = block.jacobian;
    }
    x -= normals.completeOrthogonalDecomposition().solve(values);
  }
  return x;
}

bool allowed(const Problem& problem, const Vector& x) {
  const double rounding = problem.equalities ? 1e-14 * (1.0 + x.squaredNorm()) : 0.0;
  return clamped(problem, x) == x && least_constraint(problem, x) >= -rounding;
}

Vector random_point(std::mt19937& generator, const Vector& low, const Vector& high) {
  Vector x(low.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double share = std::uniform_real_distribution<double>(0.0, 1.0)(generator);
    x[i] = low[i] + share * (high[i] - low[i]);
  }
  return x;
}

/// The start and some points around it and the minimisers, nearer to them than the box is.
std::vector<Vector> places_of(const KnownProblem& known) {
  std::mt19937 generator(7);
  const Problem box = boxed(known);
  std::vector<Vector> places{known.problem.start};
  for (const Vector& x : known.minimisers) {
    const Vector middle = 0.5 * (x + known.problem.start);
    const Vector reach = 0.1 * (*box.upper - *box.lower);
    for (int i = 0; i < 5; ++i) {
      places.push_back(random_point(generator, middle - reach, middle + reach));
    }
  }
  return places;
}

// Central differences of the fourth order.
MatrixXd differences(const std::function<VectorXd(const Vector&)>& function, const Vector& x) {
  MatrixXd slopes(function(x).size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double h = 1e-4 * (1.0 + std::abs(x[i]));
    const auto at = [&](double step) {
      Vector moved = x;
      moved[i] += step * h;
      return function(moved);
    };
    slopes.col(i) = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
  }
  return slopes;
}

void expect_close(const MatrixXd& exact, const MatrixXd& differences, double values_up_to) {
  // What rounding makes of a difference, and what the fourth order leaves.
  const double rounding = 1e-11 * values_up_to;
  const double tolerance = 1e-7 * (1.0 + exact.cwiseAbs().maxCoeff()) + rounding;
  EXPECT_LT((exact - differences).cwiseAbs().maxCoeff(), tolerance) << "exact:\n"
                                                                    << exact << "\ndifferences:\n"
                                                                    << differences;
}

class KnownProblems : public testing::TestWithParam<std::string> {
 protected:
  const KnownProblem known = known_problem(GetParam());
  const Problem& problem = known.problem;
  const double best = problem.best_known.value_or(NAN);
};

class ProblemsWithHigherMinima : public KnownProblems {};
class ProblemsOfManyFunctions : public KnownProblems {};
class SumsOfLosses : public KnownProblems {};

template <class Property>
auto names_where(Property property) {
  std::vector<std::string> names;
  for (const KnownProblem& known : known_problems()) {
    if (property(known)) names.push_back(known.name);
  }
  return testing::ValuesIn(names);
}

TEST_P(KnownProblems, CostWhatIsStatedAtEveryMinimiserAndMoreAtTheStart) {
  ASSERT_FALSE(known.minimisers.empty());
  for (const Vector& x : known.minimisers) {
    EXPECT_NEAR(problem.evaluate(x.data()), best, 1e-9 * std::abs(best) + 1e-18);
  }
  if (least_constraint(problem, problem.start) >= 0.0) {
    EXPECT_GT(problem.evaluate(problem.start.data()), best + 1e-3 * std::abs(best));
  }
}

TEST_P(KnownProblems, AreEvaluatedWithoutAllocating) {
  constexpr int n = Unknowns::in_place;
  double slope[n], curvature[n * n];
  const std::size_t before = shoal::tests::allocations();
  for (int k = 0; k < 10; ++k) problem.evaluate(problem.start.data(), slope, curvature);
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
}

TEST_P(KnownProblems, StartInsideTheBoundsAndEndWhereAllConstraintsHold) {
  EXPECT_EQ(clamped(problem, problem.start), problem.start);
  for (const Vector& x : known.minimisers) {
    EXPECT_EQ(clamped(problem, x), x);
    EXPECT_GE(least_constraint(problem, x), -1e-12 * (1.0 + x.squaredNorm()));
  }
}

// The conditions of Karush, Kuhn and Tucker: the gradient is a sum of the inward normals of what
// the point touches, none of them negative. All choices of normals are tried.
double kkt_residual(const Problem& problem, const Vector& x) {
  const VectorXd slope = slope_of(problem, x);
  std::vector<VectorXd> normals;
  for (Eigen::Index i = 0; problem.lower && i < x.size(); ++i) {
    const VectorXd unit = VectorXd::Unit(x.size(), i);
    if (x[i] <= (*problem.lower)[i]) normals.push_back(unit);
    if (x[i] >= (*problem.upper)[i]) normals.push_back(-unit);
  }
  for (int b = 0; problem.constraints && b < problem.constraints->blocks(); ++b) {
    const Block g = block_at(*problem.constraints, b, x);
    if (g.values[0] < 1e-9 * (1.0 + x.squaredNorm())) normals.emplace_back(g.jacobian.row(0));
  }
  for (int b = 0; problem.equalities && b < problem.equalities->blocks(); ++b) {
    const VectorXd normal = block_at(*problem.equalities, b, x).jacobian.row(0);
    normals.push_back(normal);
    normals.push_back(-normal);
  }
  double least = slope.norm();
  for (std::size_t chosen = 1; chosen < (std::size_t{1} << normals.size()); ++chosen) {
    std::vector<VectorXd> some;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      if (chosen >> k & 1) some.push_back(normals[k]);
    }
    MatrixXd A(x.size(), static_cast<Eigen::Index>(some.size()));
    for (std::size_t k = 0; k < some.size(); ++k) A.col(static_cast<Eigen::Index>(k)) = some[k];
    const VectorXd multipliers = A.colPivHouseholderQr().solve(slope);
    if (multipliers.minCoeff() >= 0.0) least = std::min(least, (A * multipliers - slope).norm());
  }
  return least;
}

TEST_P(KnownProblems, HaveNoSlopeToFollowAtTheirMinimisers) {
  for (const Vector& x : known.minimisers) {
    const double stiffness = curvature_of(problem, x).norm();
    EXPECT_LT(kkt_residual(problem, x), 1e-12 * (1.0 + stiffness) * (1.0 + x.norm()));
  }
}

TEST_P(KnownProblems, AreNotLowerJustBesideTheirMinimisers) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (const Vector& x : known.minimisers) {
    int tried = 0;
    for (int i = 0; i < 400; ++i) {
      Vector direction(x.size());
      for (double& part : direction) part = normal(generator);
      const double radius = i % 2 ? 1e-3 : 1e-2;
      const Vector beside = onto_equalities(
          problem, clamped(problem, x + radius * (1.0 + x.norm()) * direction.normalized()));
      if (!allowed(problem, beside)) continue;
      ++tried;
      EXPECT_GE(problem.evaluate(beside.data()), best - 1e-12 * std::abs(best));
    }
    EXPECT_GE(tried, 10);
  }
}

TEST_P(KnownProblems, AreNowhereLowerInTheirBox) {
  std::mt19937 generator(5);
  const Problem box = boxed(known);
  for (int i = 0; i < 20000; ++i) {
    const Vector x = onto_equalities(problem, random_point(generator, *box.lower, *box.upper));
    if (!allowed(box, x)) continue;
    ASSERT_GE(problem.evaluate(x.data()), best - 1e-12 * std::abs(best)) << x.transpose();
  }
}

TEST_P(KnownProblems, KeepTheirBoundsAndAllThatMattersInAFiniteBox) {
  const Problem box = boxed(known);
  ASSERT_TRUE(box.lower->allFinite() && box.upper->allFinite());
  EXPECT_EQ(clamped(box, problem.start), problem.start);
  for (const Vector& x : known.minimisers) EXPECT_EQ(clamped(box, x), x);
  if (problem.lower) {
    EXPECT_EQ(clamped(problem, *box.lower), *box.lower);
    EXPECT_EQ(clamped(problem, *box.upper), *box.upper);
  } else {
    EXPECT_GT((*box.upper - *box.lower).minCoeff(), 0.0);
  }
}

TEST_P(ProblemsWithHigherMinima, LeadTheSteepestDescentFromTheStartToALowestPoint) {
  ASSERT_FALSE(problem.constraints);
  const Problem box = boxed(known);
  const double longest = 0.005 * (*box.upper - *box.lower).maxCoeff();
  Vector x = problem.start;
  double cost = problem.evaluate(x.data()), step = 1e-6;
  for (int i = 0; i < 200000 && step > 1e-14; ++i) {
    const Vector slope = slope_of(problem, x);
    step = std::min(step, longest / std::max(slope.norm(), 1e-30));
    const Vector next = clamped(problem, x - step * slope);
    const double next_cost = problem.evaluate(next.data());
    const bool lower = next_cost < cost;
    if (lower) x = next;
    if (lower) cost = next_cost;
    step *= lower ? 1.5 : 0.5;
  }
  EXPECT_NEAR(cost, best, 1e-5 * (1.0 + std::abs(best)));
}

TEST_P(KnownProblems, HaveTheDerivativesThatDifferencesShow) {
  for (const Vector& x : places_of(known)) {
    SCOPED_TRACE(testing::Message() << "at " << x.transpose());
    const auto cost = [&](const Vector& at) {
      return VectorXd(VectorXd::Constant(1, problem.evaluate(at.data())));
    };
    const VectorXd slope = slope_of(problem, x);
    expect_close(slope.transpose(), differences(cost, x), std::abs(cost(x)[0]));
    const auto slopes = [&](const Vector& at) { return slope_of(problem, at); };
    expect_close(curvature_of(problem, x), differences(slopes, x), slope.norm());
  }
}

TEST_P(ProblemsOfManyFunctions, HaveTheDerivativesThatDifferencesShow) {
  std::vector<const VectorFunction*> functions;
  if (problem.constraints) functions.push_back(problem.constraints.get());
  if (problem.equalities) functions.push_back(problem.equalities.get());
  if (problem.least_squares) functions.push_back(problem.least_squares->residuals.get());
  for (const VectorFunction* function : functions) {
    for (const Vector& x : places_of(known)) {
      for (int b = 0; b < function->blocks(); ++b) {
        SCOPED_TRACE(testing::Message() << "block " << b << " at " << x.transpose());
        const Block exact = block_at(*function, b, x);
        const auto values = [&](const Vector& at) {
          VectorXd v(function->block_size());
          function->evaluate(b, at.data(), v.data(), nullptr, nullptr);
          return v;
        };
        // Not to the last bit: quotients are rounded otherwise when they carry derivatives.
        EXPECT_LT((values(x) - exact.values).norm(), 1e-13 * (1.0 + exact.values.norm()));
        expect_close(exact.jacobian, differences(values, x), exact.values.norm());
        for (int k = 0; k < function->block_size(); ++k) {
          const auto rows = [&](const Vector& at) {
            return VectorXd(block_at(*function, b, at).jacobian.row(k));
          };
          expect_close(exact.hessians[static_cast<std::size_t>(k)], differences(rows, x),
                       rows(x).norm());
        }
      }
    }
  }
}

TEST_P(SumsOfLosses, AreTheWeightedSumOfTheLossesOfTheirResiduals) {
  const LeastSquares& structure = *problem.least_squares;
  for (const Vector& x : places_of(known)) {
    double cost = 0.0;
    VectorXd slope = VectorXd::Zero(x.size());
    for (int b = 0; b < structure.residuals->blocks(); ++b) {
      const Block r = block_at(*structure.residuals, b, x);
      const LossValue loss = structure.loss_at(r.values.squaredNorm());
      cost += structure.weight(b) * loss.value;
      slope += 2.0 * structure.weight(b) * loss.slope * r.jacobian.transpose() * r.values;
    }
    EXPECT_NEAR(problem.evaluate(x.data()), cost, 1e-12 * (1.0 + cost));
    EXPECT_LT((slope_of(problem, x) - slope).norm(), 1e-12 * (1.0 + slope.norm()));
  }
}

const auto its_name = [](const auto& tested) { return tested.param; };
INSTANTIATE_TEST_SUITE_P(Set, KnownProblems, testing::ValuesIn(tests::names_of_known_problems()),
                         its_name);
INSTANTIATE_TEST_SUITE_P(Set, ProblemsWithHigherMinima, names_where([](const KnownProblem& known) {
                           return known.several_minima;
                         }),
                         its_name);
INSTANTIATE_TEST_SUITE_P(Set, ProblemsOfManyFunctions, names_where([](const KnownProblem& known) {
                           return known.problem.constrained() || known.problem.least_squares;
                         }),
                         its_name);
INSTANTIATE_TEST_SUITE_P(Set, SumsOfLosses, names_where([](const KnownProblem& known) {
                           return known.problem.least_squares != nullptr;
                         }),
                         its_name);

TEST(KnownProblemSet, HoldsEveryKindOfProblemUnderANameOfItsOwn) {
  std::set<std::string> names;
  std::set<int> dimensions;
  int losses = 0, residuals = 0, constraints = 0, equalities = 0, bounds = 0, fixed = 0;
  for (const KnownProblem& known : known_problems()) {
    const Problem& problem = known.problem;
    names.insert(known.name);
    dimensions.insert(problem.dimension());
    EXPECT_TRUE(problem.best_known.has_value()) << known.name;
    EXPECT_NE(known.source, "") << known.name;
    residuals += problem.least_squares != nullptr;
    losses += problem.least_squares && problem.least_squares->loss;
    constraints += problem.constraints != nullptr;
    equalities += problem.equalities != nullptr;
    bounds += problem.lower.has_value();
    fixed += problem.lower && (*problem.upper - *problem.lower).minCoeff() == 0.0;
  }
  EXPECT_EQ(names.size(), known_problems().size());
  EXPECT_GE(names.size(), 15u);
  EXPECT_EQ(dimensions, (std::set{1, 2, 3, 4, 6}));
  EXPECT_GE(residuals, 10);
  EXPECT_GE(losses, 3);
  EXPECT_GE(constraints, 5);
  EXPECT_GE(equalities, 3);
  EXPECT_GE(bounds, 6);
  EXPECT_EQ(fixed, 1);
  EXPECT_THROW(known_problem("rosenbrok"), std::invalid_argument);
}

TEST(KnownProblemSet, CostsAtTheStartWhatTheSourcesSay) {
  const std::map<std::string, double> costs{{"rosenbrock", 24.2},
                                            {"beale", 14.203125},
                                            {"helical_valley", 2500.0},
                                            {"wood", 19192.0},
                                            {"powell_singular", 215.0},
                                            {"extended_rosenbrock", 3 * 24.2},
                                            {"himmelblau", 170.0},
                                            {"mccormick", 1.0},
                                            {"hock_schittkowski_4", 3.323568},
                                            {"hock_schittkowski_11", -24.98},
                                            {"hock_schittkowski_24", -0.01336459},
                                            {"hock_schittkowski_29", -1.0},
                                            {"hock_schittkowski_35", 2.25},
                                            {"rosen_suzuki", 0.0}};
  for (const auto& [name, cost] : costs) {
    const Problem problem = known_problem(name).problem;
    EXPECT_NEAR(problem.evaluate(problem.start.data()), cost, 1e-7 * (1.0 + std::abs(cost)))
        << name;
  }
}

TEST(KnownProblemSet, RegistersAsTheClosedFormDoes) {
  const KnownProblem known = known_problem("registration");
  const LeastSquares& structure = *known.problem.least_squares;
  const Vector identity = Vector::Zero(3);
  const std::vector<Eigen::Vector2d> slots{{0, 0}, {300, 0}, {0, 300}, {300, 300}, {600, 150}};
  Procrustes pairs;
  for (int b = 0; b < structure.residuals->blocks(); ++b) {
    const Eigen::Vector2d slot = slots[static_cast<std::size_t>(b)];
    const Eigen::Vector2d seen = slot - block_at(*structure.residuals, b, identity).values;
    pairs.add(slot, seen, structure.weight(b));
  }
  const RegistrationSolution closed = pairs.solve();
  const Vector x = known.minimisers.front();
  EXPECT_NEAR(closed.cost, *known.problem.best_known, 1e-9);
  const Eigen::Vector2d far_slot(600.0, 150.0);
  const Eigen::Vector2d moved =
      Eigen::Rotation2Dd(x[0] / 300.0) * far_slot + Eigen::Vector2d(x[1], x[2]);
  EXPECT_LT((closed.T_to_from * far_slot - moved).norm(), 1e-9);
}

}  // namespace
}  // namespace shoal::solvers
