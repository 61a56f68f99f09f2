#include "shoal/analysis/benchmarking/problem_family.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::analysis {
namespace {

struct KeptSmooth {
  using Solver = solvers::Solver;
  using Solution = solvers::Solution;

  explicit KeptSmooth(const solvers::Problem& problem) : kept(problem) {}
  const solvers::Problem& problem() const { return kept; }
  static Eigen::VectorXd place(const solvers::Problem&, const Solution& solution) {
    return solution.x;
  }

  solvers::Problem kept;
};

const Register<ProblemFamily, ProblemFamilyOf<KeptSmooth>> registered{
    "smooth", "the minimum of a smooth cost of a few unknowns or of many"};

}  // namespace
}  // namespace shoal::analysis
