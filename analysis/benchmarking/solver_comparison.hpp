#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shoal/analysis/benchmarking/corpus.hpp"
#include "shoal/analysis/benchmarking/solver_answer.hpp"
#include "shoal/analysis/tables/table.hpp"

namespace shoal::analysis {

struct ComparisonSettings {
  std::vector<std::string> solvers;
  std::string reference;  ///< whose minimum is "the same" one; empty: a family's first solver
  Setting options;        ///< family -> solver -> option
  /// Whether every problem is solved once more, to trace it: the times stay those without.
  bool progress = false;
};

/// One solver, and its answers to all problems of its family in their order.
struct Contender {
  std::string name;
  std::vector<SolverAnswer> answers;
};

struct ContenderFamily {
  std::string name;  ///< of the family of solvers
  std::vector<Contender> contenders;
  std::size_t reference = 0;
};

/// Several solvers side by side on the problems of a corpus.
///
/// A name stands for the members of that name in every family of solvers; a family's problems go
/// to those of its members that were named.
class SolverComparison {
 public:
  /// Throws InputError for a name that no family knows, an unknown option, and a reference that is
  /// not among the solvers.
  explicit SolverComparison(const ComparisonSettings& settings);
  ~SolverComparison();

  void run(const Corpus& corpus);

  /// Families of which a solver was named and a problem was met.
  std::vector<const ContenderFamily*> families() const;

 private:
  struct Entrants;  // of one family
  std::vector<Entrants> entrants_;
  bool progress_;
};

/// Shares are of the problems posed; evaluations, times and gaps are of those solved. The gap is
/// the excess of the cost over the lowest that any of the solvers found, in the cost's own unit.
Table comparison_table(const SolverComparison& comparison, double same_within_m);

/// Dolan and Moré 2002, Benchmarking optimization software with performance profiles: the share of
/// the problems that a solver solves within a factor of the least time (or evaluations) of all.
/// Any local minimum counts as solved.
Table performance_profiles(const SolverComparison& comparison);

/// How far solvers have come after so many evaluations or seconds: the quartiles over the problems
/// of the share of the descent that is left, (cost - lowest) / (first - lowest). The lowest cost is
/// that of all solvers together, the first the highest that one of them began with. A solver that
/// refuses a problem, or has not evaluated it yet, has all of the descent before it; where there is
/// nothing to descend, none. Closed forms and enumerations have no curve.
Table progress_curves(const SolverComparison& comparison);

}  // namespace shoal::analysis
