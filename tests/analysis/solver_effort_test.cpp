// What solvers do for a behaviour, as a measure.

#include <gtest/gtest.h>

#include "shoal/analysis/experiments/trial.hpp"
#include "tests/analysis/parked_trials.hpp"

namespace shoal::analysis {
namespace {

using namespace test;

TEST(SolverEffort, CountsWhatSolversDo) {
  const Settings few = {"trial.duration_s=300"};
  const Results closed = run(few, {"behaviour.kind=rigid_registration"}).results;
  EXPECT_GT(*closed.at("solves_per_target"), 0.0);
  EXPECT_LE(*closed.at("solves_per_target"), 1.0) << "none where no other vehicle was heard";
  EXPECT_EQ(closed.at("solve_evaluations"), 0.0) << "closed form";
  const Results two = run(few, {"behaviour.kind=assignment_registration"}).results;
  EXPECT_GT(*two.at("solves_per_target"), 1.0) << "a matching and a registration";
  const Results descent = run(few, {"behaviour.kind=attraction_repulsion"}).results;
  EXPECT_GT(*descent.at("solve_evaluations"), 1.0);
  EXPECT_EQ(descent.at("solve_budget_share"), 0.0);
  EXPECT_EQ(descent.at("solve_time_s"), std::nullopt) << "no time was asked for";
}

TEST(SolverEffort, KnowsHowSolversFail) {
  const Results results = run({"trial.duration_s=300", "behaviour.kind=attraction_repulsion",
                               "behaviour.attraction_repulsion.solver.newton.max_evaluations=1"})
                              .results;
  EXPECT_GT(*results.at("solve_budget_share"), 0.5);
  EXPECT_EQ(results.at("solve_diverged_share"), 0.0);
}

TEST(SolverEffort, TimesSolvesIfAskedAndChangesNothingElse) {
  const Settings few = {"trial.duration_s=300"};
  Results timed = run(few, {"trial.time_solves=true"}).results;
  EXPECT_GT(*timed.at("solve_time_s"), 0.0);
  for (auto& [name, value] : timed.values) {
    if (name == "solve_time_s") value = std::nullopt;
  }
  EXPECT_EQ(timed.values, run(few).results.values);
}

}  // namespace
}  // namespace shoal::analysis
