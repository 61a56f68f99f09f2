#include <gtest/gtest.h>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/solvers/problems.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

std::unique_ptr<Solver> multistart(
    std::initializer_list<std::pair<const char*, decltype(Setting::value)>> options = {}) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, Setting{value, {}});
  return Registry<Solver>::instance().make("multistart", table, "test");
}

Problem himmelblau() {
  Problem problem = tests::known_problem("himmelblau").problem;
  problem.lower = Vector2d(-5, -5);
  problem.upper = Vector2d(5, 5);
  return problem;
}

TEST(Multistart, CountsTheMinimaThatItSaw) {
  EXPECT_EQ(multistart()->solve(himmelblau()).distinct_minima, 4);
  EXPECT_EQ(multistart({{"starts", std::int64_t{1}}})->solve(himmelblau()).distinct_minima, 1);
  EXPECT_EQ(multistart({{"same_minimum_m", 100.0}})->solve(himmelblau()).distinct_minima, 1);
}

// Two minima mirrored in the line through the neighbours: a vehicle sees one, a search both.
TEST(Multistart, SearchesABoxRoundTheStartWhereThereAreNoBounds) {
  const Problem problem = tests::known_problem("two_neighbours").problem;
  ASSERT_FALSE(problem.lower);
  EXPECT_EQ(multistart()->solve(problem).distinct_minima, 2);
  EXPECT_EQ(multistart({{"radius_m", 1.0}})->solve(problem).distinct_minima, 1);
}

TEST(Multistart, FindsTheLowestMinimumFromTheBasinOfAHigherOne) {
  const auto wells = [](const auto* x) {  // at about (1, 0) and, lower, (-1, 0)
    const auto square = x[0] * x[0] - 1.0;
    return square * square + 0.2 * x[0] + x[1] * x[1];
  };
  Problem problem(Vector2d(1, 0), differentiated<2>(wells));
  problem.lower = Vector2d(-2, -2);
  problem.upper = Vector2d(2, 2);
  const auto alone = Registry<Solver>::instance().make("newton", Setting{}, "test");
  EXPECT_GT(alone->solve(problem).x[0], 0.5);
  EXPECT_LT(multistart()->solve(problem).x[0], -0.5);
}

TEST(Multistart, TakesAnySolverAndItsOptions) {
  const Solution few = multistart({{"solver.kind", "nlopt.lbfgs"},
                                   {"solver.nlopt.lbfgs.max_evaluations", std::int64_t{3}}})
                           ->solve(himmelblau());
  EXPECT_LE(few.evaluations, 3 * 32);
  EXPECT_EQ(multistart({{"solver.kind", "nlopt.slsqp"}})->solve(himmelblau()).distinct_minima, 4);
  if (Registry<Solver>::instance().find("ipopt")) {  // which may be left out
    EXPECT_NE(multistart({{"solver.kind", "ipopt"}})->one_at_a_time(), std::nullopt);
  }
}

TEST(Multistart, MovesItsStartsWithTheSeed) {
  const auto few = [](std::int64_t seed) {
    return multistart({{"starts", std::int64_t{3}}, {"seed", seed}})
        ->solve(himmelblau())
        .evaluations;
  };
  EXPECT_EQ(few(0), few(0));
  bool any_other = false;
  for (std::int64_t seed = 1; seed < 6; ++seed) any_other |= few(seed) != few(0);
  EXPECT_TRUE(any_other);
}

}  // namespace
}  // namespace shoal::solvers
