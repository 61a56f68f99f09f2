#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

std::unique_ptr<Solver> newton(
    std::initializer_list<std::pair<const char*, decltype(Setting::value)>> options = {}) {
  Setting table;
  for (const auto& [name, value] : options) table.at_or_new(name).value = value;
  return Registry<Solver>::instance().make("newton", table, "test");
}

// Rypkema 2015, eq. 3.4-3.7 with two neighbours.
struct TwoNeighbours {
  Vector2d a{-280, -81}, b{-25, -193};
  double separation = 300.0;

  template <class T>
  T operator()(const T* p) const {
    using std::sqrt;
    const double s = separation;
    T cost(0.0);
    for (const Vector2d& n : {a, b}) {
      const T dx = p[0] - n.x(), dy = p[1] - n.y();
      const T squared = dx * dx + dy * dy;
      cost = cost + 0.5 * s * s * s / squared + sqrt(squared) - 3.0 * s;
    }
    const T dx = p[0] - 0.5 * (a.x() + b.x()), dy = p[1] - 0.5 * (a.y() + b.y());
    return cost + 1e-5 * (dx * dx + dy * dy);
  }
};

Problem problem_of(const TwoNeighbours& swarm) {
  return Problem(Vector2d(0, 0), differentiated<2>(swarm));
}

/// Where the slope leads from the start: the minimum that a vehicle would reach by drifting down.
Vector2d end_of_steepest_descent(const Problem& problem) {
  Vector2d x = problem.start, slope;
  double cost = problem.evaluate(x.data(), slope.data());
  double step = 1.0;
  while (slope.norm() > 1e-6 && step > 1e-9) {
    const Vector2d there = x - std::min(step, 50.0 * slope.norm()) * slope.normalized();
    Vector2d slope_there;
    const double cost_there = problem.evaluate(there.data(), slope_there.data());
    if (cost_there < cost) {
      x = there;
      cost = cost_there;
      slope = slope_there;
      step = std::min(1.0, 1.5 * step);
    } else {
      step *= 0.5;
    }
  }
  return x;
}

std::vector<TwoNeighbours> random_swarms(int count, double separation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> distance(60.0, 600.0);
  std::uniform_real_distribution<double> bearing(0.0, 2.0 * std::numbers::pi);
  std::vector<TwoNeighbours> swarms;
  for (int k = 0; k < count; ++k) {
    const double r1 = distance(random), b1 = bearing(random);
    const double r2 = distance(random), b2 = bearing(random);
    swarms.push_back({{r1 * std::cos(b1), r1 * std::sin(b1)},
                      {r2 * std::cos(b2), r2 * std::sin(b2)},
                      separation});
  }
  return swarms;
}

TEST(Newton, FindsThePlaceOfFigure37InFewEvaluations) {
  const Solution solution = newton()->solve(problem_of({}));
  EXPECT_EQ(name_of(solution.status), "converged");
  EXPECT_NEAR((Vector2d(solution.x) - Vector2d(-45.7795, 105.9797)).norm(), 0.0, 1e-4);
  EXPECT_NEAR(solution.cost, -899.294820, 1e-6);
  EXPECT_LE(solution.evaluations, 12);
}

// A vehicle between two neighbours may go to either side of them; it shall go where the slope
// leads, and never to the far side of a neighbour.
TEST(Newton, EndsWhereTheSlopeLeads) {
  for (const double separation : {100.0, 300.0}) {
    int same = 0, leapt = 0;
    const auto swarms = random_swarms(1000, separation);
    for (const TwoNeighbours& swarm : swarms) {
      const Problem problem = problem_of(swarm);
      const Solution solution = newton()->solve(problem);
      EXPECT_EQ(name_of(solution.status), "converged");
      const Vector2d downhill = end_of_steepest_descent(problem);
      const Vector2d x = solution.x;
      same += (x - downhill).norm() < 0.5;
      leapt += x.norm() > downhill.norm() + separation;
    }
    EXPECT_GE(same, 995) << "separation " << separation;
    EXPECT_EQ(leapt, 0) << "separation " << separation;
  }
}

// Across the slope this cost curves downwards, which is no reason to swerve.
TEST(Newton, GoesStraightAwayFromASingleNeighbour) {
  const auto ring = [](const auto* p) {
    using std::sqrt;
    const auto squared = p[0] * p[0] + (p[1] - 200.0) * (p[1] - 200.0);
    return 0.5 * 300.0 * 300.0 * 300.0 / squared + sqrt(squared) - 900.0;
  };
  const Solution solution = newton()->solve(Problem(Vector2d(0, 0), differentiated<2>(ring)));
  EXPECT_EQ(name_of(solution.status), "converged");
  EXPECT_NEAR((Vector2d(solution.x) - Vector2d(0, -100)).norm(), 0.0, 1e-3);
}

TEST(Newton, NeverStepsFurtherThanAllowed) {
  struct Watched : TwoNeighbours {
    std::vector<Vector2d>* seen;
    Watched(const TwoNeighbours& swarm, std::vector<Vector2d>* points)
        : TwoNeighbours(swarm), seen(points) {}
    Taylor<2> operator()(const Taylor<2>* p) const {
      seen->emplace_back(p[0].value, p[1].value);
      return TwoNeighbours::operator()(p);
    }
    double operator()(const double* p) const { return TwoNeighbours::operator()(p); }
  };
  for (const TwoNeighbours& swarm : random_swarms(50, 300.0)) {
    std::vector<Vector2d> seen;
    newton({{"first_radius_m", 5.0}, {"largest_radius_m", 40.0}})
        ->solve(Problem(Vector2d(0, 0), differentiated<2>(Watched(swarm, &seen))));
    ASSERT_GE(seen.size(), 2u);
    EXPECT_LE((seen[1] - seen[0]).norm(), 5.0 * 1.01);
    for (std::size_t k = 1; k < seen.size(); ++k) {
      double nearest = 1e9;  // of the points before, from one of which it was reached
      for (std::size_t j = 0; j < k; ++j) nearest = std::min(nearest, (seen[k] - seen[j]).norm());
      EXPECT_LE(nearest, 40.0 * 1.01);
    }
  }
}

TEST(Newton, LeavesASaddleAndASummit) {
  const auto double_well = [](const auto* x) {
    return x[0] * x[0] - x[1] * x[1] + x[1] * x[1] * x[1] * x[1];
  };
  const Solution off_saddle =
      newton()->solve(Problem(Vector2d(0, 0), differentiated<2>(double_well)));
  EXPECT_EQ(name_of(off_saddle.status), "converged");
  EXPECT_NEAR(std::abs(off_saddle.x[1]), std::sqrt(0.5), 1e-4);

  const auto hat = [](const auto* x) {
    const auto squared = x[0] * x[0] + x[1] * x[1];
    return (squared - 1.0) * (squared - 1.0);
  };
  const Solution off_summit = newton()->solve(Problem(Vector2d(0, 0), differentiated<2>(hat)));
  EXPECT_TRUE(off_summit.usable());
  EXPECT_NEAR(off_summit.x.norm(), 1.0, 1e-3);
}

TEST(Newton, GoesOnWithShorterStepsWhereTheCostIsNotFinite) {
  const auto barrier = [](const auto* x) {  // NaN for x <= 0; lowest at x = 1
    using std::log;
    return 10.0 * (x[0] - log(x[0])) + x[1] * x[1];
  };
  const Solution solution = newton({{"first_radius_m", 100.0}})
                                ->solve(Problem(Vector2d(60, 3), differentiated<2>(barrier)));
  EXPECT_EQ(name_of(solution.status), "converged");
  EXPECT_NEAR((Vector2d(solution.x) - Vector2d(1, 0)).norm(), 0.0, 1e-4);
}

/// x >= 0.
struct Above {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = x[0];
  }
};

TEST(Newton, SaysWhatItDoesNotTake) {
  Problem problem(Vector2d(0, 0),
                  differentiated<2>([](const auto* x) { return x[0] * x[0] + x[1] * x[1]; }));
  problem.constraints = differentiated_blocks<2>(Above{});
  EXPECT_EQ(newton()->refuses(problem).value_or(""), "takes no constraints");
  EXPECT_EQ(name_of(newton()->solve(problem).status), "bad_input");
}

TEST(Newton, RefusesAFirstStepLongerThanTheLongest) {
  EXPECT_THROW(newton({{"first_radius_m", 10.0}, {"largest_radius_m", 5.0}}), InputError);
}

TEST(Newton, AllocatesNothing) {
  const auto solver = newton();
  const Problem problem = problem_of({});
  const std::size_t before = shoal::tests::allocations();
  solver->solve(problem);
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
}

}  // namespace
}  // namespace shoal::solvers
