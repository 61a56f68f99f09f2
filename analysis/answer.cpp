#include "shoal/analysis/answer.hpp"

#include <chrono>

namespace shoal::analysis {
namespace {

template <class Member, class Problem>
auto solved_in_time(const Member& solver, const Problem& problem, SolverAnswer& answer) {
  const auto begin = std::chrono::steady_clock::now();
  const auto solution = solver.solve(problem);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  answer.cost = solution.cost;
  return solution;
}

SolverAnswer refusal(std::string why) {
  SolverAnswer answer;
  answer.refused = true;
  answer.status = std::move(why);
  return answer;
}

template <class Point>
Eigen::VectorXd stacked(std::size_t count, Point point) {
  Eigen::VectorXd all(2 * static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    all.segment<2>(2 * static_cast<Eigen::Index>(i)) = point(i);
  }
  return all;
}

}  // namespace

SolverAnswer answered(const solvers::Solver& solver, const solvers::Problem& problem) {
  if (auto why = solver.refuses(problem)) return refusal(std::move(*why));
  SolverAnswer answer;
  const solvers::Solution solution = solved_in_time(solver, problem, answer);
  answer.solved = solution.status == solvers::Status::converged;
  answer.status = name_of(solution.status);
  answer.place = solution.x;
  answer.evaluations = solution.evaluations;
  return answer;
}

SolverAnswer answered(const solvers::RegistrationSolver& solver,
                      const solvers::RegistrationProblem& problem) {
  if (auto why = solver.refuses(problem)) return refusal(std::move(*why));
  SolverAnswer answer;
  const solvers::RegistrationSolution solution = solved_in_time(solver, problem, answer);
  answer.solved = solution.status == solvers::RegistrationStatus::fitted;
  answer.status = name_of(solution.status);
  answer.place = stacked(problem.pairs.size(), [&](std::size_t i) -> Eigen::Vector2d {
    return solution.T_to_from * problem.pairs[i].from;
  });
  answer.evaluations = solution.evaluations;
  return answer;
}

SolverAnswer answered(const solvers::Matcher& solver, const solvers::MatchingProblem& problem) {
  SolverAnswer answer;
  const solvers::MatchingSolution solution = solved_in_time(solver, problem, answer);
  answer.solved = solution.usable();
  answer.status = solution.usable() ? "matched" : "bad_input";
  answer.place = stacked(solution.slot_of_point.size(), [&](std::size_t i) -> Eigen::Vector2d {
    return problem.slots[static_cast<std::size_t>(solution.slot_of_point[i])];
  });
  return answer;
}

}  // namespace shoal::analysis
