#include "shoal/solvers/registration/registration.hpp"

#include "shoal/analysis/benchmarking/problem_family.hpp"

namespace shoal::analysis {
namespace {

struct KeptRegistration {
  using Solver = solvers::RegistrationSolver;
  using Solution = solvers::RegistrationSolution;

  explicit KeptRegistration(const solvers::RegistrationProblem& problem)
      : pairs(problem.pairs.begin(), problem.pairs.end()), loss(problem.loss) {}
  solvers::RegistrationProblem problem() const { return {pairs, loss}; }
  static Eigen::VectorXd place(const solvers::RegistrationProblem& problem,
                               const Solution& solution) {
    return stacked(problem.pairs.size(), [&](std::size_t i) -> Eigen::Vector2d {
      return solution.T_to_from * problem.pairs[i].from;
    });
  }

  std::vector<solvers::PointPair> pairs;
  const solvers::Loss* loss;  // the behaviour's, which outlives the comparison
};

const Register<ProblemFamily, ProblemFamilyOf<KeptRegistration>> registered{
    "registration", "the rigid motion that lays points best onto their partners"};

}  // namespace
}  // namespace shoal::analysis
