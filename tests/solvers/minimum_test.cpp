#include "shoal/solvers/smooth/minimum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/solvers/autodiff.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
constexpr double tolerance_m = 1e-4;
constexpr double steepest = 10.0;

bool is_minimum(const Problem& problem, const Problem::Vector& x) {
  return is_local_minimum(problem, x, tolerance_m, steepest);
}

const auto bowl = [](const auto* x) {
  return (x[0] - 3.0) * (x[0] - 3.0) + 2.0 * (x[1] + 2.0) * (x[1] + 2.0);
};

Problem in_box(Problem problem, const Vector2d& lower, const Vector2d& upper) {
  problem.lower = lower;
  problem.upper = upper;
  return problem;
}

template <class Cost>
Problem posed(const Cost& cost) {
  return Problem(Vector2d(0, 0), differentiated<2>(cost));
}

/// At least 0 inside the unit circle.
struct UnitDisc {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = 1.0 - x[0] * x[0] - x[1] * x[1];
  }
};

/// At least 0 outside of it.
struct OutsideUnitDisc {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = x[0] * x[0] + x[1] * x[1] - 1.0;
  }
};

TEST(Minimum, IsFoundWithinTheToleranceAndNoFurther) {
  EXPECT_TRUE(is_minimum(posed(bowl), Vector2d(3, -2)));
  EXPECT_TRUE(is_minimum(posed(bowl), Vector2d(3 + 5e-4, -2)));  // the backends bound their step
  EXPECT_FALSE(is_minimum(posed(bowl), Vector2d(3 + 5e-3, -2)));
}

TEST(Minimum, IsNoSaddleAndNoSummit) {
  EXPECT_FALSE(
      is_minimum(posed([](const auto* x) { return x[0] * x[0] - x[1] * x[1]; }), Vector2d(0, 0)));
  EXPECT_FALSE(is_minimum(posed([](const auto* x) { return -(x[0] * x[0] + x[1] * x[1]); }),
                          Vector2d(0, 0)));
}

// Beside the slope on the walls of a valley, that along its floor is nothing; it leads far.
TEST(Minimum, IsNotTheFloorOfALongValley) {
  const auto valley = [](const auto* x) { return 1e7 * x[0] * x[0] + x[1] * x[1]; };
  EXPECT_FALSE(is_local_minimum(posed(valley), Vector2d(0, 3), tolerance_m, 1e8));
  EXPECT_TRUE(is_local_minimum(posed(valley), Vector2d(0, 3e-4), tolerance_m, 1e8));
}

TEST(Minimum, MayBeFlat) {
  const auto quartic = [](const auto* x) {
    return x[0] * x[0] * x[0] * x[0] + x[1] * x[1] * x[1] * x[1];
  };
  EXPECT_TRUE(is_minimum(posed(quartic), Vector2d(1e-3, 0)));
  EXPECT_FALSE(is_minimum(posed(quartic), Vector2d(0.1, 0)));
  const auto valley = [](const auto* x) { return (x[0] - x[1]) * (x[0] - x[1]); };
  EXPECT_TRUE(is_minimum(posed(valley), Vector2d(5, 5)));
  EXPECT_FALSE(is_minimum(posed(valley), Vector2d(5, 5.01)));
  EXPECT_TRUE(is_minimum(posed([](const auto* x) { return 0.0 * x[0]; }), Vector2d(7, 7)));
}

TEST(Minimum, LiesOnABoundThatTheSlopePressesAgainst) {
  const Problem problem = in_box(posed(bowl), {-1, -1}, {1, 1});
  EXPECT_TRUE(is_minimum(problem, Vector2d(1, -1)));
  EXPECT_FALSE(is_minimum(problem, Vector2d(1, 0.5)));  // along the bound it goes on
  EXPECT_FALSE(is_minimum(problem, Vector2d(-1, -1)));  // the slope leads back inside
  EXPECT_FALSE(is_minimum(in_box(posed(bowl), {3.5, -9}, {9, -2.5}), Vector2d(9, -9)));
}

TEST(Minimum, OfAConcaveCostIsACorner) {
  const Problem problem =
      in_box(posed([](const auto* x) { return -(x[0] * x[0]) - x[1]; }), {-2, -1}, {1, 1});
  EXPECT_TRUE(is_minimum(problem, Vector2d(1, 1)));
  EXPECT_TRUE(is_minimum(problem, Vector2d(-2, 1)));
  EXPECT_FALSE(is_minimum(problem, Vector2d(0, 1)));  // a summit along the bound
}

TEST(Minimum, LiesOnACurvedConstraint) {
  Problem inside = posed([](const auto* x) { return x[0] + x[1]; });
  inside.constraints = differentiated_blocks<2>(UnitDisc{});
  const double h = std::sqrt(0.5);
  EXPECT_TRUE(is_minimum(inside, Vector2d(-h, -h)));
  EXPECT_FALSE(is_minimum(inside, Vector2d(h, h)));   // the worst point of the disc
  EXPECT_FALSE(is_minimum(inside, Vector2d(-1, 0)));  // along the circle it goes on
}

TEST(Minimum, LiesOnAnEquality) {
  Problem circle = posed([](const auto* x) { return x[0] + x[1]; });
  circle.equalities = differentiated_blocks<2>(UnitDisc{});
  const double h = std::sqrt(0.5);
  EXPECT_TRUE(is_minimum(circle, Vector2d(-h, -h)));
  EXPECT_FALSE(is_minimum(circle, Vector2d(h, h)));  // a summit along the circle
  EXPECT_FALSE(is_minimum(circle, Vector2d(-1, 0)));
  // Where the cost has no slope, the equality still leaves only its own directions: across it, the
  // cost falls.
  Problem ridge = posed([](const auto* x) { return x[1] * x[1] - (x[0] + 1.0) * (x[0] + 1.0); });
  ridge.equalities = differentiated_blocks<2>(UnitDisc{});
  EXPECT_TRUE(is_minimum(ridge, Vector2d(-1, 0)));
  ridge.equalities = nullptr;
  EXPECT_FALSE(is_minimum(ridge, Vector2d(-1, 0)));
}

// The cost alone curves upwards here; along the circle it falls away from the foot point behind it.
TEST(Minimum, CountsTheBendOfTheConstraint) {
  Problem outside = posed([](const auto* x) { return (x[0] - 0.5) * (x[0] - 0.5) + x[1] * x[1]; });
  outside.constraints = differentiated_blocks<2>(OutsideUnitDisc{});
  EXPECT_TRUE(is_minimum(outside, Vector2d(1, 0)));
  EXPECT_FALSE(is_minimum(outside, Vector2d(-1, 0)));
  Problem behind =
      posed([](const auto* x) { return (x[0] + 0.5) * (x[0] + 0.5) + 4.0 * x[1] * x[1]; });
  behind.constraints = differentiated_blocks<2>(OutsideUnitDisc{});
  EXPECT_TRUE(is_minimum(behind, Vector2d(-1, 0)));
}

TEST(Minimum, IsNotSeenWhereAnythingIsNotFinite) {
  EXPECT_FALSE(is_minimum(posed([](const auto* x) {
                            using std::sqrt;
                            return sqrt(x[0]) + x[1] * x[1];
                          }),
                          Vector2d(0, 0)));
}

TEST(Violation, IsTheWorstOfItsKind) {
  Problem problem = in_box(posed(bowl), {-1, -1}, {1, 1});
  EXPECT_EQ(bounds_violation(problem, Vector2d(0.5, 1)), 0.0);
  EXPECT_EQ(bounds_violation(problem, Vector2d(1.25, -3)), 2.0);
  EXPECT_EQ(constraint_violation(problem, Vector2d(5, 5)), 0.0);
  problem.constraints = differentiated_blocks<2>(UnitDisc{});
  EXPECT_EQ(constraint_violation(problem, Vector2d(2, 0)), 3.0);
  EXPECT_TRUE(std::isnan(constraint_violation(problem, Vector2d(NAN, 0))));
  problem.equalities = differentiated_blocks<2>(UnitDisc{});
  EXPECT_EQ(constraint_violation(problem, Vector2d(0, 0)), 1.0) << "inside the disc, off its edge";
  EXPECT_EQ(constraint_violation(problem, Vector2d(0, 1)), 0.0);
  EXPECT_TRUE(std::isnan(constraint_violation(problem, Vector2d(NAN, 0))));
}

}  // namespace
}  // namespace shoal::solvers
