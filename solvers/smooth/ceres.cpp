#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <glog/logging.h>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

struct CeresOptions : Limits {
  static void declare(Options<CeresOptions>& o) { declare_limits(o); }
};

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

/// Ceres' own tolerance is relative to |x|, which is about zero at a vehicle's target.
class ShortStep final : public ceres::IterationCallback {
 public:
  explicit ShortStep(Attempt& attempt) : attempt_(attempt) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (attempt_.must_stop()) return ceres::SOLVER_ABORT;
    if (iteration.iteration == 0) return ceres::SOLVER_CONTINUE;
    return attempt_.may_end_after(iteration.step_norm) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                       : ceres::SOLVER_CONTINUE;
  }

 private:
  Attempt& attempt_;
};

template <ceres::LineSearchDirectionType direction>
class LineSearch final : public Solver {
 public:
  explicit LineSearch(const CeresOptions& options) : options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, options_);
    if (!attempt.open()) return attempt.finish(0, "");

    ceres::GradientProblem posed(new Cost(attempt));
    ShortStep short_step(attempt);
    ceres::GradientProblemSolver::Options options;
    options.line_search_direction_type = direction;
    options.logging_type = ceres::SILENT;
    options.max_num_iterations = static_cast<int>(options_.max_evaluations);
    options.function_tolerance = 0.0;
    options.gradient_tolerance = 0.0;
    options.parameter_tolerance = 0.0;
    options.callbacks.push_back(&short_step);
    ceres::GradientProblemSolver::Summary summary;
    Problem::Vector y = attempt.start();
    ceres::Solve(options, posed, y.data(), &summary);
    return attempt.finish(summary.termination_type,
                          ceres::TerminationTypeToString(summary.termination_type));
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constraints) return "takes no constraints";
    if (problem.lower) return "takes no bounds";
    return std::nullopt;
  }

 private:
  CeresOptions options_;
};

template <ceres::LineSearchDirectionType direction>
const auto made =
    [](const CeresOptions& options) { return std::make_unique<LineSearch<direction>>(options); };

const Enrol<Solver, CeresOptions> enrolled[] = {
    {"ceres.lbfgs", "Ceres: limited-memory BFGS", made<ceres::LBFGS>},
    {"ceres.bfgs", "Ceres: BFGS", made<ceres::BFGS>}};

}  // namespace

void silence_backends() {
  FLAGS_minloglevel = google::GLOG_FATAL;
}

}  // namespace shoal::solvers
