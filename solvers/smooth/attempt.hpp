#pragma once

#include <chrono>
#include <exception>
#include <span>
#include <utility>
#include <vector>

#include "shoal/core/small_vector.hpp"
#include "shoal/solvers/smooth/limits.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {

/// One solve of one problem: stands between a backend and the cost.
///
/// Counts evaluations and ends them when the budget is spent, keeps exceptions and costs that are
/// not finite from the backend, leaves out unknowns that are fixed by equal bounds (backends
/// stumble over them), remembers the best point, and judges it in the end. Everything that a
/// backend says about its success is ignored.
///
/// Points y, gradients and matrices are in the free unknowns only.
class Attempt {
 public:
  /// What a backend learns of an evaluation.
  enum class Outcome : std::uint8_t {
    fine,
    not_finite,  ///< no such point; those that can may try a shorter step
    stop,        ///< the budget is spent or the cost threw: come to an end
  };

  Attempt(const Problem& problem, const Limits& limits);
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  /// False if there is nothing to do for a backend (a flaw in the problem, no free unknown):
  /// finish() has the answer.
  bool open() const { return open_; }

  int unknowns() const { return free_count_; }
  Problem::Vector start() const { return free_part(problem_.start); }
  bool bounded() const { return problem_.lower.has_value(); }
  Problem::Vector lower() const { return free_part(*problem_.lower); }
  Problem::Vector upper() const { return free_part(*problem_.upper); }
  int constraints() const { return problem_.constraints ? problem_.constraints->blocks() : 0; }
  int equalities() const { return problem_.equalities ? problem_.equalities->blocks() : 0; }

  /// Where the Hessian of the cost and of what constrains it may differ from zero: row and column
  /// of its lower triangle. Known of sums of squares; of other costs it is everywhere.
  std::vector<std::pair<int, int>> hessian_pattern() const;

  /// The cost at y, its gradient and its Hessian (column-major) where they are not null.
  Outcome evaluate(const double* y, double& cost, double* gradient = nullptr,
                   double* hessian = nullptr);

  /// Constraint k at y: first those that are to be at least zero, then the equalities. Not counted
  /// as an evaluation. Of a linear one the Hessian is zero.
  Outcome constrain(int k, const double* y, double& value, double* gradient = nullptr,
                    double* hessian = nullptr);

  /// The free unknowns that constraint k depends on, rising; its other derivatives are zero.
  std::vector<int> unknowns_of_constraint(int k) const;
  bool linear_constraint(int k) const { return constraint(k).function.linear(); }

  /// For solvers of least squares, which ask for residuals instead of costs: begins an evaluation
  /// at a new point. Its cost follows when all blocks were asked for once, in their order.
  Outcome begin_residuals();

  /// The free unknowns that a block of the residuals depends on, rising.
  std::vector<int> unknowns_of_residuals(int block) const;

  /// One block of the residuals, which has free unknowns, at y, with its Jacobian (row-major) by
  /// those unknowns where that is not null.
  Outcome residuals(int block, const double* y, double* values, double* jacobian);

  bool must_stop() const { return stopped_; }

  /// The best point so far; NaN before the first fine evaluation.
  Problem::Vector best() const { return free_part(best_); }

  /// Whether a backend that has just made a step of this length (m) may end: if the step is short
  /// and the best point is a minimum. A step may also be short because the line search or the trust
  /// region is; then it may go on, for some more short steps.
  bool may_end_after(double step);

  /// The highest cost so far: what a backend may be given that needs a number where there is none.
  /// -infinity before the first fine evaluation.
  double worst_cost() const { return worst_cost_; }

  /// Judges the best point. Rethrows what the cost threw. `code` and `says` (a literal): the
  /// backend's own words.
  Solution finish(int code, const char* says);

  /// The same for our own solvers, whose criterion is a check of the point: `converged`.
  Solution finish_converged(const char* says);

 private:
  struct Block {
    const VectorFunction& function;
    int place;
  };

  const char* flaw() const;
  Block constraint(int k) const;
  double cost_of(int block, const double* residuals) const;
  std::vector<int> free_among(std::span<const int> unknowns) const;
  Problem::Vector free_part(const Problem::Vector& all) const;
  int free(int k) const { return free_[static_cast<std::size_t>(k)]; }
  const double* place(const double* y);  ///< all unknowns at y
  bool may_go_on();                      ///< counts an evaluation, or ends the attempt
  /// What a function of all unknowns gives at y, in the free ones; whether that is finite.
  template <class Function>
  bool reduced(const Function& function, const double* y, double& value, double* gradient,
               double* hessian);
  void remember(const double* x, double cost);
  bool at_minimum() const;
  Status judge() const;
  Solution answer(Status status, int code, const char* says) const;

  /// Runs what may throw.
  template <class Function>
  Outcome guarded(Function function);

  static constexpr double feasibility = 1e-6;  // of a constraint, in its own unit

  const Problem& problem_;
  const Limits limits_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  const bool restricted_;  // by bounds or constraints
  SmallVector<int, Unknowns::in_place> free_;
  int free_count_ = 0;
  bool all_free_ = false;
  bool open_ = false;
  const char* wrong_ = nullptr;

  Problem::Vector point_, best_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  double best_violation_ = 0.0;
  double worst_cost_ = -std::numeric_limits<double>::infinity();
  double largest_gradient_squared_ = 0.0;
  double cost_of_blocks_ = 0.0;
  int next_block_ = 0;
  std::vector<int> fixed_blocks_;  ///< of the residuals: those of unknowns that are all fixed
  int short_steps_ = 0;            // in a row
  std::int64_t evaluations_ = 0;
  std::exception_ptr failure_;
  bool stopped_ = false;
  bool met_not_finite_ = false;
};

}  // namespace shoal::solvers
