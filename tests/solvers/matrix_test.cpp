// Every solver on every known problem: solved, or it says why it does not take it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "shoal/solvers/solver.hpp"
#include "tests/solvers/problems.hpp"

namespace shoal::solvers {
namespace {

using tests::KnownProblem;

constexpr double cost_tolerance = 1e-6;  // of the lowest cost, or absolute where that is small

/// Enough for every method to come to an end of its own, and an end as near as can be tested.
std::unique_ptr<Solver> patient(const std::string& name) {
  const auto& registry = Registry<Solver>::instance();
  const Schema& schema = registry.find(name)->schema();
  Setting options;
  if (schema.find("x_tolerance_m")) options.at_or_new("x_tolerance_m").value = 1e-7;
  if (const Setting* budget = schema.defaults.find("max_evaluations")) {
    const auto usual = std::get<std::int64_t>(budget->value);
    const bool local = usual < 2000;
    options.at_or_new("max_evaluations").value = local ? std::int64_t{100'000} : usual;
  }
  return registry.make(name, options, "solver." + name);
}

/// Where a method comes to its limits, which it must not take for a success.
struct Limit {
  const char* solver;
  const char* problem;
  const char* why;
};
constexpr Limit limits[] = {
    {"grid", "tilted_bowl", "the valley is a thousand times narrower than long, and aslant"},
    {"nlopt.ccsaq", "tilted_bowl", "its models have no cross terms: it creeps"},
    {"nlopt.ccsaq", "wood", "its models have no cross terms: it creeps"},
    {"nlopt.ccsaq", "helical_valley", "it creeps, and has met the line without a cost"},
    {"nlopt.cobyla", "tilted_bowl", "its models have no bends: it creeps"},
    {"nlopt.cobyla", "helical_valley", "it creeps, and has met the line without a cost"},
    {"nlopt.mma", "tilted_bowl", "its models have no cross terms: it creeps"},
    {"nlopt.mma", "wood", "its models have no cross terms: it creeps"},
    {"nlopt.neldermead", "six_hump_camel", "its simplex collapses against a bound"},
    {"nlopt.praxis", "hock_schittkowski_4", "bounds are walls to it: it sticks to one"},
};

const char* limit_of(const std::string& solver, const std::string& problem) {
  for (const Limit& limit : limits) {
    if (solver == limit.solver && problem == limit.problem) return limit.why;
  }
  return nullptr;
}

struct Outcome {
  char mark = '?';
  std::string detail;

  bool explained() const { return mark != 'X'; }
};

Outcome outcome_of(const std::string& name, const Solver& solver, const KnownProblem& known) {
  Problem problem = known.problem;
  if (solver.refuses(problem) && !solver.refuses(tests::boxed(known))) {
    problem = tests::boxed(known);
  }
  const Solution solution = solver.solve(problem);
  if (const auto why = solver.refuses(problem)) {
    return {solution.status == Status::bad_input ? '-' : 'X', *why};
  }
  const double best = *known.problem.best_known;
  const double gap = solution.cost - best;
  const bool feasible = solution.violation <= 1e-6;
  if (solution.usable() && feasible && gap <= cost_tolerance * std::max(1.0, std::abs(best))) {
    return {'o', ""};
  }
  if (solution.status == Status::converged && feasible && known.several_minima) return {'m', ""};
  const char* limit = limit_of(name, known.name);
  if (limit && solution.status != Status::converged) return {'!', known.name + ": " + limit};
  char text[200];
  std::snprintf(text, sizeof text, "%s (%s): gap %.3g, violation %.3g, %d evaluations",
                std::string(name_of(solution.status)).c_str(), solution.backend_says, gap,
                solution.violation, solution.evaluations);
  return {'X', text};
}

TEST(SolverMatrix, IsSolvedOrExplainedEverywhere) {
  const std::vector<KnownProblem> problems = tests::known_problems();
  ASSERT_GE(problems.size(), 15u);
  std::printf(
      "every solver on every known problem:\n"
      "  o solved   m another local minimum   - refused, with the reason below\n\n");
  std::map<std::string, std::vector<std::string>> reasons;
  std::size_t width = 0;
  for (const std::string& name : Registry<Solver>::instance().names()) {
    width = std::max(width, name.size());
  }
  for (const std::string& name : Registry<Solver>::instance().names()) {
    const auto solver = patient(name);
    std::string row;
    for (std::size_t k = 0; k < problems.size(); ++k) {
      const Outcome outcome = outcome_of(name, *solver, problems[k]);
      EXPECT_TRUE(outcome.explained())
          << name << " on " << problems[k].name << ": " << outcome.detail;
      row += outcome.mark;
      if (outcome.mark == '-' || outcome.mark == '!') {
        auto& of_solver = reasons[name];
        if (std::ranges::find(of_solver, outcome.detail) == of_solver.end()) {
          of_solver.push_back(outcome.detail);
        }
      }
    }
    std::printf("  %-*s  %s\n", static_cast<int>(width), name.c_str(), row.c_str());
    EXPECT_NE(row.find('o'), std::string::npos) << name << " solves nothing";
  }
  std::printf("\n");
  for (const auto& [name, of_solver] : reasons) {
    for (const std::string& reason : of_solver) {
      std::printf("  %-*s  %s\n", static_cast<int>(width), name.c_str(), reason.c_str());
    }
  }
  std::printf("\nthe problems, from left to right:\n");
  for (const KnownProblem& known : problems) {
    std::printf("  %-28s %s\n", known.name.c_str(), known.source.c_str());
  }
}

}  // namespace
}  // namespace shoal::solvers
