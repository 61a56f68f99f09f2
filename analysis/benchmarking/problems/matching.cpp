#include "shoal/solvers/matching/matching.hpp"

#include "shoal/analysis/benchmarking/problem_family.hpp"

namespace shoal::analysis {
namespace {

struct KeptMatching {
  using Solver = solvers::Matcher;
  using Solution = solvers::MatchingSolution;

  explicit KeptMatching(const solvers::MatchingProblem& problem)
      : points(problem.points.begin(), problem.points.end()),
        slots(problem.slots.begin(), problem.slots.end()),
        ownship_weight(problem.ownship_weight) {}
  solvers::MatchingProblem problem() const { return {points, slots, ownship_weight}; }
  static Eigen::VectorXd place(const solvers::MatchingProblem& problem, const Solution& solution) {
    return stacked(solution.slot_of_point.size(), [&](std::size_t i) {
      return problem.slots[static_cast<std::size_t>(solution.slot_of_point[i])];
    });
  }

  std::vector<Eigen::Vector2d> points, slots;
  double ownship_weight;
};

const Register<ProblemFamily, ProblemFamilyOf<KeptMatching>> registered{
    "matching", "which slot of the plan each point takes"};

}  // namespace
}  // namespace shoal::analysis
