// What observers of a planner see.

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/formations/engineer.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

/// Counts what is shown, and keeps the costs of the answers.
struct Watcher final : PlanObserver {
  int smooth = 0, registration = 0, matching = 0;
  int answers = 0;
  std::vector<double> costs;
  std::vector<Target> targets;

  void answered(const solvers::Answer& answer, double seconds) override {
    ++answers;
    EXPECT_EQ(answer.status, solvers::Status::converged);
    EXPECT_EQ(seconds, 0.0) << "no time was asked for";
  }
  void solved(const solvers::Solved& what) override {
    if (what.problem<solvers::Problem>()) {
      see(*what.problem<solvers::Problem>(), *what.answer<solvers::Solution>());
    } else if (what.problem<solvers::RegistrationProblem>()) {
      see(*what.problem<solvers::RegistrationProblem>(),
          *what.answer<solvers::RegistrationSolution>());
    } else if (what.problem<solvers::MatchingProblem>()) {
      see(*what.problem<solvers::MatchingProblem>(), *what.answer<solvers::MatchingSolution>());
    } else {
      ADD_FAILURE() << "a problem of no known family";
    }
  }
  void planned(const Neighbourhood& seen, const Target& target) override {
    EXPECT_EQ(seen.own_slot, 0);
    targets.push_back(target);
  }

 private:
  void see(const solvers::Problem& problem, const solvers::Solution& answer) {
    ++smooth;
    costs.push_back(answer.cost);
    EXPECT_NEAR(problem.evaluate(answer.x.data()), answer.cost, 1e-9 * std::abs(answer.cost));
  }
  void see(const solvers::RegistrationProblem& problem,
           const solvers::RegistrationSolution& answer) {
    ++registration;
    costs.push_back(answer.cost);
    double sum = 0.0;
    for (const solvers::PointPair& p : problem.pairs) {
      sum += p.weight * (answer.T_to_from * p.from - p.to).squaredNorm();
    }
    EXPECT_NEAR(sum, answer.cost, 1e-9 * (1.0 + sum));
  }
  void see(const solvers::MatchingProblem& problem, const solvers::MatchingSolution& answer) {
    ++matching;
    costs.push_back(answer.cost);
    EXPECT_EQ(problem.points.size(), answer.slot_of_point.size());
  }
};

TEST(Planner, ShowsObserversEachProblemThatItSolvesWithItsAnswer) {
  const Neighbours seen = heard(cross_plan, 0, {}, {-20, 5});
  for (const char* kind : {"rigid_registration", "pairwise_referencing", "attraction_repulsion",
                           "assignment_registration"}) {
    Engineer watched(cross_plan, kind), alone(cross_plan, kind);
    Watcher one, other;
    watched.planner.observe(one);
    watched.planner.observe(other);
    EXPECT_TRUE(watched.planner.plan(0.0, {.position = start}).held());
    EXPECT_TRUE(one.costs.empty()) << "it heard no other vehicle, and solved nothing";
    for (Engineer* each : {&watched, &alone}) each->hear(seen, 1.0, start);
    const Target target = watched.planner.plan(2.0, {.position = start});
    EXPECT_EQ(target.position, alone.planner.plan(2.0, {.position = start}).position) << kind;
    const bool assigns = std::string_view(kind) == "assignment_registration";
    EXPECT_EQ(one.matching, assigns ? 1 : 0) << kind;
    EXPECT_EQ(one.smooth + one.registration, 1) << kind;
    EXPECT_EQ(one.answers, one.smooth + one.registration + one.matching) << kind;
    ASSERT_EQ(one.targets.size(), 2u);
    EXPECT_EQ(one.targets.back().position, target.position);
    EXPECT_EQ(one.costs, other.costs);
  }
}

TEST(Planner, TimesWhatItSolvesIfAnObserverWantsThat) {
  struct Timer final : PlanObserver {
    int answers = 0;
    double seconds = 0.0;
    Wants wants() const override { return {.problems = false, .times = true}; }
    void answered(const solvers::Answer&, double taken) override {
      ++answers;
      seconds += taken;
    }
    void solved(const solvers::Solved&) override { ADD_FAILURE(); }
  };
  for (const char* kind : {"rigid_registration", "pairwise_referencing"}) {
    Engineer engineer(cross_plan, kind);
    Timer timer;
    engineer.planner.observe(timer);
    engineer.hear(heard(cross_plan, 0, {}, {-20, 5}), 1.0, start);
    engineer.planner.plan(2.0, {.position = start});
    EXPECT_EQ(timer.answers, 1) << kind;
    EXPECT_GE(timer.seconds, 0.0);
  }
}

}  // namespace
}  // namespace shoal::formations
