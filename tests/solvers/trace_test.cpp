#include "shoal/solvers/trace.hpp"

#include <gtest/gtest.h>

#include <string>

#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/solvers/problems.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::solvers {
namespace {

using tests::known_problems;
using tests::KnownProblem;

class Traced : public testing::TestWithParam<std::string> {};

TEST_P(Traced, NotesEachTimeThatTheLowestCostFell) {
  const auto solver = Registry<Solver>::instance().make(GetParam(), {}, "solver");
  int traced = 0;
  for (const KnownProblem& known : known_problems()) {
    if (solver->refuses(known.problem)) continue;
    SCOPED_TRACE(known.name);
    ++traced;
    const Solution untraced = solver->solve(known.problem);
    Problem problem = known.problem;
    Trace trace;
    problem.trace = &trace;
    const Solution solution = solver->solve(problem);
    EXPECT_TRUE(solution.x == untraced.x || !solution.x.allFinite()) << "the answer changes";
    EXPECT_EQ(solution.evaluations, untraced.evaluations);
    if (!solution.usable()) continue;
    ASSERT_FALSE(trace.points().empty());
    EXPECT_EQ(trace.points().back().cost, solution.cost);
    EXPECT_LE(trace.points().back().evaluations, solution.evaluations);
    Trace::Point before{0, 0.0, std::numeric_limits<double>::infinity()};
    for (const Trace::Point& point : trace.points()) {
      EXPECT_GT(point.evaluations, before.evaluations);
      EXPECT_GE(point.seconds, before.seconds);
      EXPECT_LT(point.cost, before.cost);
      before = point;
    }
  }
  EXPECT_GT(traced, 5);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Traced,
                         testing::Values("newton", "ipopt", "ceres.least_squares", "nlopt.slsqp",
                                         "nlopt.neldermead", "multistart"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

TEST(Trace, OfARegistrationIsThatOfItsDescents) {
  const PointPair pairs[] = {{{0, 0}, {10, 0}}, {{100, 0}, {10, 100}}, {{0, 50}, {-43, 1}}};
  Trace trace;
  RegistrationProblem problem{pairs};
  problem.trace = &trace;
  const auto solver = Registry<RegistrationSolver>::instance().make("newton", {}, "solver");
  const RegistrationSolution solution = solver->solve(problem);
  ASSERT_TRUE(solution.usable());
  ASSERT_FALSE(trace.points().empty());
  EXPECT_LE(trace.points().back().evaluations, solution.evaluations);
}

}  // namespace
}  // namespace shoal::solvers
