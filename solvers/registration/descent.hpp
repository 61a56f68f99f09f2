#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// Registers with a solver of smooth problems, whatever the loss.
///
/// Three unknowns, all in metres, so that a tolerance means the same for each: the arc along which
/// a point at the root mean square distance from the weighted centroid turns (unbounded: any number
/// of turns), and the shift of that centroid. They are zero at the start.
///
/// Robust costs have several minima, and Tukey's is flat far away. Such problems are solved from
/// two starts, and the lower answer counts: the best motion of least squares, which every pair
/// pulls at; and, of the motions that two pairs alone fix, the one of the lowest cost, which
/// outliers do not reach while half of the pairs agree. It is looked for among all twos of up to 64
/// pairs; of longer lists 64 are taken, evenly spread.
class RegistrationByDescent final : public RegistrationSolver {
 public:
  explicit RegistrationByDescent(std::unique_ptr<const Solver> solver)
      : solver_(std::move(solver)) {}

  RegistrationSolution solve(const RegistrationProblem& problem) const override;
  std::optional<std::string> refuses(const RegistrationProblem& problem) const override;
  std::optional<std::string> one_at_a_time() const override { return solver_->one_at_a_time(); }

 private:
  std::unique_ptr<const Solver> solver_;
};

/// A name that may stand between angle brackets.
template <std::size_t N>
struct SolverName {
  char text[N];
  constexpr SolverName(const char (&name)[N]) { std::copy_n(name, N, text); }  // NOLINT: implicit
};

/// Registers the registration by one smooth solver, and hands on that solver's options:
///
///     const RegisterDescent<"newton"> registered{"newton", "what it does"};
template <SolverName name>
struct RegisterDescent {
  RegisterDescent(std::string as, std::string summary) {
    Registry<RegistrationSolver>::instance().add(
        {std::move(as), std::move(summary), []() -> const Schema& { return smooth().schema(); },
         [](const Setting& table, const std::string& path) { smooth().check(table, path); },
         [](const Setting& table, const std::string& path) {
           return smooth().complete(table, path);
         }},
        [](const Setting& table, const std::string& path) -> std::unique_ptr<RegistrationSolver> {
          return std::make_unique<RegistrationByDescent>(
              Registry<Solver>::instance().make(name.text, table, path));
        });
  }

 private:
  // Looked up when asked for: at start-up that solver may not be registered yet.
  static const MemberInfo& smooth() { return *Registry<Solver>::instance().find(name.text); }
};

}  // namespace shoal::solvers
