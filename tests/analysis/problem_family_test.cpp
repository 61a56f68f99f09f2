// A family of problems of one's own, beside those of the library.

#include "shoal/analysis/benchmarking/problem_family.hpp"

#include <gtest/gtest.h>

#include "shoal/solvers/solver.hpp"

namespace shoal::analysis {
namespace {

/// The middle of points on a line.
struct MiddleProblem {
  std::span<const double> points;
};
struct MiddleSolution : solvers::Answer {
  double middle = 0.0;
};

class MiddleSolver {
 public:
  static constexpr const char* family = "middle";
  static constexpr const char* family_meaning = "finds the middle of points";
  virtual ~MiddleSolver() = default;
  virtual MiddleSolution solve(const MiddleProblem& problem) const = 0;
  std::optional<std::string> refuses(const MiddleProblem& problem) const {
    return problem.points.empty() ? std::optional<std::string>("takes no empty set") : std::nullopt;
  }
};

struct Half final : MiddleSolver {
  double share = 0.5;
  static void declare(Options<Half>& o) {
    o.number("share", &Half::share, "", in(0.0, 1.0), "how far towards the last");
  }
  MiddleSolution solve(const MiddleProblem& problem) const override {
    MiddleSolution answer;
    answer.status = solvers::Status::converged;
    answer.middle = problem.points.front() * (1.0 - share) + problem.points.back() * share;
    answer.cost = std::abs(answer.middle);
    return answer;
  }
};
const Register<MiddleSolver, Half> registered{"half", "between the first and the last"};

struct KeptMiddle {
  using Solver = MiddleSolver;
  using Solution = MiddleSolution;
  explicit KeptMiddle(const MiddleProblem& problem)
      : points(problem.points.begin(), problem.points.end()) {}
  MiddleProblem problem() const { return {points}; }
  static Eigen::VectorXd place(const MiddleProblem&, const MiddleSolution& solution) {
    return Eigen::VectorXd::Constant(1, solution.middle);
  }
  std::vector<double> points;
};

TEST(ProblemFamily, KeepsItsOwnProblemsOnlyAndSolvesThemByEachSolver) {
  ProblemFamilyOf<KeptMiddle> family;
  family.add_solver("half", {}, "middle.half");
  Setting third;
  third.at_or_new("share").value = 0.25;
  family.add_solver("half", third, "middle.half");
  {
    const std::vector<double> points{1.0, 3.0};  // gone before they are solved
    const MiddleProblem problem{points}, empty{};
    family.keep({problem, MiddleSolution{}});
    family.keep({solvers::Solution{}, MiddleSolution{}});
    family.keep({empty, MiddleSolution{}});
  }
  const auto answers = family.answers(false);
  ASSERT_EQ(answers.size(), 2u);
  ASSERT_EQ(answers[0].size(), 2u);
  EXPECT_EQ(answers[0][0].place[0], 2.0);
  EXPECT_EQ(answers[1][0].place[0], 1.5);
  EXPECT_EQ(answers[1][0].cost, 1.5);
  EXPECT_TRUE(answers[0][0].solved());
  EXPECT_EQ(answers[0][1].refusal, "takes no empty set");
  EXPECT_TRUE(family.answers(false)[0].empty()) << "they are let go";
  EXPECT_EQ(&family.solvers(), &Registry<MiddleSolver>::instance());
}

TEST(ProblemFamily, OfEveryFamilyOfSolversThereIsOne) {
  const auto& kinds = Registry<ProblemFamily>::instance();
  std::vector<std::string> solved;
  for (const std::string& name : kinds.names()) {
    solved.push_back(kinds.make(name, {}, name)->solvers().family());
  }
  EXPECT_EQ(solved, (std::vector<std::string>{"matching", "registration", "solver"}));
}

}  // namespace
}  // namespace shoal::analysis
