#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "shoal/analysis/benchmarking/solver_answer.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/solvers/solve_observer.hpp"

namespace shoal::analysis {

/// Kept problems of one family, and the solvers of that family that are compared on them.
class ProblemFamily {
 public:
  static constexpr const char* family = "problem";
  static constexpr const char* family_meaning =
      "is stated by behaviours, and solved by the solvers of its family";

  virtual ~ProblemFamily() = default;

  /// Of the solvers.
  virtual const RegistryBase& solvers() const = 0;
  /// One more solver to compare: a member of solvers(). `path` is that of its options.
  virtual void add_solver(const std::string& name, const Setting& options,
                          const std::string& path) = 0;
  /// Copies the problem, if it is of this family.
  virtual void keep(const solvers::Solved& solved) = 0;
  /// For each solver, its answers to all kept problems, which are then let go: they may go by what
  /// stated them. `progress`: every problem is solved once more, to trace it.
  virtual std::vector<std::vector<SolverAnswer>> answers(bool progress) = 0;
};

/// The problems of a family, as `Kept` describes them, with a solver of type `Kept::Solver`:
///
///     using Solver = ...;    // abstract, registered
///     using Solution = ...;  // what its solve() returns
///     explicit Kept(const Problem&);  // owns what the problem borrows
///     Problem problem() const;
///     static Eigen::VectorXd place(const Problem&, const Solution&);  // SolverAnswer::place
template <class Kept>
class ProblemFamilyOf : public ProblemFamily {
 public:
  using Solver = typename Kept::Solver;
  using Problem = std::remove_cvref_t<decltype(std::declval<const Kept&>().problem())>;

  static void declare(Options<ProblemFamilyOf>&) {}

  const RegistryBase& solvers() const override { return Registry<Solver>::instance(); }

  void add_solver(const std::string& name, const Setting& options,
                  const std::string& path) override {
    solvers_.push_back(Registry<Solver>::instance().make(name, options, path));
  }

  void keep(const solvers::Solved& solved) override {
    if (const Problem* problem = solved.problem<Problem>()) kept_.emplace_back(*problem);
  }

  std::vector<std::vector<SolverAnswer>> answers(bool progress) override {
    std::vector<std::vector<SolverAnswer>> all;
    // One solver after another, not problem by problem: a large one would leave the others a cold
    // cache, and a time that is not theirs.
    for (const auto& solver : solvers_) {
      std::vector<SolverAnswer>& answers = all.emplace_back();
      for (const Kept& each : kept_) answers.push_back(answer(*solver, each.problem()));
      if (!progress) continue;
      for (std::size_t k = 0; k < kept_.size(); ++k) {
        if (answers[k].refusal.empty()) answers[k].progress = trace(*solver, kept_[k].problem());
      }
    }
    kept_.clear();
    return all;
  }

 private:
  static SolverAnswer answer(const Solver& solver, const Problem& problem) {
    SolverAnswer answer;
    if (auto why = solver.refuses(problem)) {
      answer.refusal = std::move(*why);
      return answer;
    }
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const typename Kept::Solution solution = solver.solve(problem);
    answer.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    static_cast<solvers::Answer&>(answer) = solution;
    answer.place = Kept::place(problem, solution);
    return answer;
  }

  static std::vector<solvers::Trace::Point> trace(const Solver& solver, Problem problem) {
    solvers::Trace trace;
    if constexpr (requires { problem.trace; }) {
      problem.trace = &trace;
      trace.begin();
      solver.solve(problem);
    }
    return trace.points();
  }

  std::vector<std::shared_ptr<const Solver>> solvers_;
  std::vector<Kept> kept_;
};

}  // namespace shoal::analysis
