#include "shoal/solvers/smooth/ceres.hpp"

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <vector>

#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

/// Ceres' own tolerance is relative to |x|, which is about zero at a vehicle's target.
class ShortStep final : public ceres::IterationCallback {
 public:
  explicit ShortStep(Attempt& attempt) : attempt_(attempt) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (attempt_.must_stop()) return ceres::SOLVER_ABORT;
    if (iteration.iteration == 0 || !iteration.step_is_successful) return ceres::SOLVER_CONTINUE;
    return attempt_.may_end_after(iteration.step_norm) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                       : ceres::SOLVER_CONTINUE;
  }

 private:
  Attempt& attempt_;
};

/// Leaves the end to the attempt.
template <class BackendOptions>
void hand_over(ShortStep& short_step, const Limits& limits, BackendOptions& options) {
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = static_cast<int>(limits.max_evaluations);
  options.function_tolerance = 0.0;
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 0.0;
  options.callbacks.push_back(&short_step);
}

// Any smooth cost --------------------------------------------------------------------------------

class Cost final : public ceres::FirstOrderFunction {
 public:
  explicit Cost(Attempt& attempt) : attempt_(attempt) {}

  int NumParameters() const override { return attempt_.unknowns(); }
  bool Evaluate(const double* y, double* cost, double* gradient) const override {
    return attempt_.evaluate(y, *cost, gradient) == Attempt::Outcome::fine;
  }

 private:
  Attempt& attempt_;
};

template <ceres::LineSearchDirectionType direction>
class LineSearch final : public Solver {
 public:
  explicit LineSearch(const Limits& limits) : limits_(limits) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, limits_);
    if (!attempt.open()) return attempt.finish(0, "");

    ceres::GradientProblem posed(new Cost(attempt));
    ShortStep short_step(attempt);
    ceres::GradientProblemSolver::Options options;
    options.line_search_direction_type = direction;
    hand_over(short_step, limits_, options);
    ceres::GradientProblemSolver::Summary summary;
    Problem::Vector y = attempt.start();
    ceres::Solve(options, posed, y.data(), &summary);
    return attempt.finish(summary.termination_type,
                          ceres::TerminationTypeToString(summary.termination_type));
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constrained()) return "takes no constraints";
    if (problem.lower) return "takes no bounds";
    return std::nullopt;
  }

 private:
  Limits limits_;
};

// Sums of squares --------------------------------------------------------------------------------

/// A block of residuals that depends on all unknowns, which are one block of parameters.
class Block final : public ceres::CostFunction {
 public:
  Block(Attempt& attempt, int block, int size) : attempt_(attempt), block_(block) {
    set_num_residuals(size);
    mutable_parameter_block_sizes()->push_back(attempt.unknowns());
  }

  bool Evaluate(double const* const* y, double* residuals, double** jacobians) const override {
    double* jacobian = jacobians ? jacobians[0] : nullptr;
    return attempt_.residuals(block_, y[0], residuals, jacobian) == Attempt::Outcome::fine;
  }

 private:
  Attempt& attempt_;
  int block_;
};

/// One that depends on some unknowns, each a block of parameters of its own. `y` are all of them:
/// Ceres writes the point of an evaluation there before a callback sees it.
class SparseBlock final : public ceres::CostFunction {
 public:
  SparseBlock(Attempt& attempt, int block, int size, const double* y, int unknowns)
      : attempt_(attempt), block_(block), y_(y), jacobian_(size, unknowns) {
    set_num_residuals(size);
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(unknowns), 1);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    double* wanted = jacobians ? jacobian_.data() : nullptr;
    if (attempt_.residuals(block_, y_, residuals, wanted) != Attempt::Outcome::fine) return false;
    for (Eigen::Index i = 0; jacobians && i < jacobian_.cols(); ++i) {
      if (jacobians[i])
        Eigen::Map<Eigen::VectorXd>(jacobians[i], jacobian_.rows()) = jacobian_.col(i);
    }
    return true;
  }

 private:
  Attempt& attempt_;
  int block_;
  const double* y_;
  mutable Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian_;
};

class WeightedLoss final : public ceres::LossFunction {
 public:
  WeightedLoss(const LeastSquares& structure, double weight)
      : structure_(structure), weight_(weight) {}

  void Evaluate(double squared, double rho[3]) const override {
    const LossValue loss = structure_.loss_at(squared);
    rho[0] = weight_ * loss.value;
    rho[1] = weight_ * loss.slope;
    rho[2] = weight_ * loss.curvature;
  }

 private:
  const LeastSquares& structure_;
  double weight_;
};

/// Sees every point that Ceres tries: for the count, the budget and the best point.
class Trials final : public ceres::EvaluationCallback {
 public:
  explicit Trials(Attempt& attempt) : attempt_(attempt) {}

  void PrepareForEvaluation(bool, bool new_point) override {
    if (new_point) attempt_.begin_residuals();
  }

 private:
  Attempt& attempt_;
};

/// Levenberg-Marquardt on the residuals.
class TrustRegion final : public Solver {
 public:
  explicit TrustRegion(const Limits& limits) : limits_(limits) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, limits_);
    if (!attempt.open()) return attempt.finish(0, "");

    const LeastSquares& structure = *problem.least_squares;
    Problem::Vector y = attempt.start();
    Trials trials(attempt);
    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &trials;
    ceres::Problem posed(problem_options);
    const int blocks = structure.residuals->blocks(), size = structure.residuals->block_size();
    const bool sparse = blocks > 0 && !structure.residuals->unknowns_of(0).empty();
    for (int k = 0; sparse && k < attempt.unknowns(); ++k) posed.AddParameterBlock(&y[k], 1);
    for (int b = 0; b < blocks; ++b) {
      const auto new_loss = [&] { return new WeightedLoss(structure, structure.weight(b)); };
      if (!sparse) {
        posed.AddResidualBlock(new Block(attempt, b, size), new_loss(), y.data());
        continue;
      }
      std::vector<double*> own;
      for (const int k : attempt.unknowns_of_residuals(b)) own.push_back(&y[k]);
      if (own.empty()) continue;  // all fixed: the attempt knows its cost
      posed.AddResidualBlock(
          new SparseBlock(attempt, b, size, y.data(), static_cast<int>(own.size())), new_loss(),
          own);
    }
    if (attempt.bounded()) {
      const Problem::Vector lower = attempt.lower(), upper = attempt.upper();
      for (int k = 0; k < attempt.unknowns(); ++k) {
        double* parameters = sparse ? &y[k] : y.data();
        posed.SetParameterLowerBound(parameters, sparse ? 0 : k, lower[k]);
        posed.SetParameterUpperBound(parameters, sparse ? 0 : k, upper[k]);
      }
    }
    ShortStep short_step(attempt);
    ceres::Solver::Options options;
    options.linear_solver_type = sparse ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
    hand_over(short_step, limits_, options);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &posed, &summary);
    return attempt.finish(summary.termination_type,
                          ceres::TerminationTypeToString(summary.termination_type));
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (!problem.least_squares) return "needs residuals: the cost is no sum of squares";
    if (problem.constrained()) return "takes no constraints";
    return std::nullopt;
  }

 private:
  Limits limits_;
};

template <class Member, class Backend>
const Register<Solver, Backend> registered_as(const char* name, const char* summary) {
  return {name, summary,
          [](const Backend& options) { return std::make_unique<Member>(Limits::of(options)); }};
}

const auto lbfgs = registered_as<LineSearch<ceres::LBFGS>, CeresLbfgs>(
    "ceres.lbfgs", "Ceres: limited-memory BFGS");
const auto bfgs = registered_as<LineSearch<ceres::BFGS>, CeresBfgs>("ceres.bfgs", "Ceres: BFGS");
const auto least_squares = registered_as<TrustRegion, CeresLeastSquares>(
    "ceres.least_squares", "Ceres: Levenberg-Marquardt on residuals, with robust losses");

}  // namespace

void CeresLbfgs::declare(Options<CeresLbfgs>& o) {
  declare_limits(o);
}

void CeresBfgs::declare(Options<CeresBfgs>& o) {
  declare_limits(o);
}

void CeresLeastSquares::declare(Options<CeresLeastSquares>& o) {
  declare_limits(o);
}

void silence_backends() {
  FLAGS_minloglevel = google::GLOG_FATAL;
}

}  // namespace shoal::solvers
