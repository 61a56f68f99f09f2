#include <nlopt.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>

#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Problem::max_dimension,
                             Problem::max_dimension>;

struct NloptOptions {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;
  double initial_step_m = 1.0;

  static void declare(Options<NloptOptions>& o) {
    o.integer("max_evaluations", &NloptOptions::max_evaluations, "", in(1, 1e9),
              "evaluations of the cost after which the solver stops");
    // The optimum lies near the origin of the own frame, where a relative tolerance cannot be met.
    o.number("x_tolerance_m", &NloptOptions::x_tolerance_m, "m", above(0.0),
             "step below which the solver stops, absolute");
    o.number("initial_step_m", &NloptOptions::initial_step_m, "m", above(0.0),
             "first step of the methods that use no derivatives");
  }
};

struct Algorithm {
  const char* name;
  nlopt_algorithm id;
  bool uses_gradient;
  int least_unknowns;
  const char* summary;
};

// COBYLA is left out: it may never return, whatever limits are set.
constexpr std::array algorithms{
    Algorithm{"nlopt.lbfgs", NLOPT_LD_LBFGS, true, 1, "NLopt: limited-memory BFGS"},
    Algorithm{"nlopt.slsqp", NLOPT_LD_SLSQP, true, 1, "NLopt: sequential quadratic programming"},
    Algorithm{"nlopt.mma", NLOPT_LD_MMA, true, 1, "NLopt: method of moving asymptotes"},
    Algorithm{"nlopt.ccsaq", NLOPT_LD_CCSAQ, true, 1,
              "NLopt: conservative convex separable quadratic approximations"},
    Algorithm{"nlopt.tnewton", NLOPT_LD_TNEWTON, true, 1, "NLopt: truncated Newton"},
    Algorithm{"nlopt.var2", NLOPT_LD_VAR2, true, 1, "NLopt: variable metric, rank 2"},
    Algorithm{"nlopt.bobyqa", NLOPT_LN_BOBYQA, false, 2,
              "NLopt: quadratic models without derivatives (used by Rypkema 2015)"},
    Algorithm{"nlopt.neldermead", NLOPT_LN_NELDERMEAD, false, 1, "NLopt: Nelder-Mead simplex"},
    Algorithm{"nlopt.sbplx", NLOPT_LN_SBPLX, false, 1, "NLopt: Subplex, simplices on subspaces"},
    Algorithm{"nlopt.praxis", NLOPT_LN_PRAXIS, false, 1,
              "NLopt: principal axes, without derivatives"},
};

// What is wrong with the start or the bounds, or nullptr.
const char* flaw(const Problem& problem) {
  const Vector& start = problem.start;
  if (start.size() < 1) return "the start has no unknowns";
  if (!start.allFinite()) return "the start is not finite";
  if (problem.lower.has_value() != problem.upper.has_value()) {
    return "one of the bounds is missing; give both or none";
  }
  if (!problem.lower) return nullptr;
  const Vector& low = *problem.lower;
  const Vector& high = *problem.upper;
  if (low.size() != start.size() || high.size() != start.size()) {
    return "the bounds and the start differ in size";
  }
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (std::isnan(low[i]) || std::isnan(high[i])) return "a bound is NaN";
    if (low[i] > high[i]) return "a lower bound lies above its upper bound";
    if (start[i] < low[i] || start[i] > high[i]) return "the start lies outside the bounds";
  }
  return nullptr;
}

/// One solve: stands between NLopt and the cost, and remembers the best point that it saw.
class Run {
 public:
  Run(const Problem& problem, const Algorithm& algorithm, const NloptOptions& options)
      : problem_(problem), algorithm_(algorithm), options_(options), point_(problem.start) {
    for (int i = 0; i < problem.dimension(); ++i) {
      // NLopt ignores requests to stop while a lower bound equals its upper bound.
      if (!problem.lower || (*problem.lower)[i] < (*problem.upper)[i]) free_.push_back(i);
    }
    solution_.x = Vector::Constant(problem.start.size(), std::numeric_limits<double>::quiet_NaN());
  }

  Solution solve() {
    if (free_.empty()) {
      evaluate(problem_.start.data(), nullptr);
      solution_.backend_says = "every unknown is fixed by its bounds";
      if (failure_) std::rethrow_exception(failure_);
      solution_.status = met_nan_ ? Status::diverged : Status::converged;
      return solution_;
    }
    if (free_.size() < static_cast<std::size_t>(algorithm_.least_unknowns)) {
      solution_.backend_says = "needs at least two unknowns that are not fixed by their bounds";
      return solution_;
    }
    const nlopt_result result = optimise();
    if (failure_) std::rethrow_exception(failure_);
    solution_.backend_code = static_cast<int>(result);
    if (const char* says = nlopt_result_to_string(result)) solution_.backend_says = says;
    solution_.status = judge(result);
    return solution_;
  }

 private:
  nlopt_result optimise() {
    const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> owner(
        nlopt_create(algorithm_.id, static_cast<unsigned>(free_.size())), &nlopt_destroy);
    backend_ = owner.get();
    if (!backend_) throw std::bad_alloc();
    nlopt_set_min_objective(backend_, &Run::called_back, this);
    nlopt_set_maxeval(backend_, static_cast<int>(options_.max_evaluations));
    nlopt_set_xtol_abs1(backend_, options_.x_tolerance_m);
    if (!algorithm_.uses_gradient) nlopt_set_initial_step1(backend_, options_.initial_step_m);
    if (problem_.lower) {
      nlopt_set_lower_bounds(backend_, reduced(*problem_.lower).data());
      nlopt_set_upper_bounds(backend_, reduced(*problem_.upper).data());
    }
    // It draws random directions; the same problem shall give the same answer.
    if (algorithm_.id == NLOPT_LN_PRAXIS) nlopt_srand(1);
    double cost = 0.0;
    Vector x = reduced(problem_.start);
    return nlopt_optimize(backend_, x.data(), &cost);
  }

  Vector reduced(const Vector& full) const {
    Vector part(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k)
      part[static_cast<Eigen::Index>(k)] = full[free_[k]];
    return part;
  }

  static double called_back(unsigned, const double* x, double* gradient, void* self) {
    return static_cast<Run*>(self)->evaluate(x, gradient);
  }

  // NLopt is C: no exception may pass, and what it is told after a stop does not matter.
  double evaluate(const double* x, double* gradient) {
    constexpr double refused = HUGE_VAL;
    if (met_nan_ || failure_) return refused;
    if (solution_.evaluations >= options_.max_evaluations) {
      out_of_budget_ = true;
      return stop(refused);
    }
    for (std::size_t k = 0; k < free_.size(); ++k) point_[free_[k]] = x[k];
    Vector slope = Vector::Zero(point_.size());
    double cost = 0.0;
    try {
      ++solution_.evaluations;
      cost = problem_.evaluate(point_.data(), gradient ? slope.data() : nullptr);
    } catch (...) {
      failure_ = std::current_exception();
      return stop(refused);
    }
    if (!std::isfinite(cost) || !slope.allFinite()) {
      met_nan_ = true;
      return stop(refused);
    }
    if (gradient) {
      double squared = 0.0;
      for (std::size_t k = 0; k < free_.size(); ++k) {
        gradient[k] = slope[free_[k]];
        squared += gradient[k] * gradient[k];
      }
      steepest_ = std::max(steepest_, std::sqrt(squared));
    }
    if (inside_bounds(point_) && !(solution_.cost <= cost)) {
      solution_.cost = cost;
      solution_.x = point_;
    }
    return cost;
  }

  double stop(double value) {
    if (backend_) nlopt_force_stop(backend_);
    return value;
  }

  bool inside_bounds(const Vector& x) const {
    return !problem_.lower ||
           ((x - *problem_.lower).minCoeff() >= 0.0 && (*problem_.upper - x).minCoeff() >= 0.0);
  }

  Status judge(nlopt_result result) {
    if (met_nan_ || !std::isfinite(solution_.cost)) return Status::diverged;
    if (algorithm_.uses_gradient && is_minimum()) return Status::converged;
    if (out_of_budget_ || result == NLOPT_MAXEVAL_REACHED) return Status::budget;
    if (!algorithm_.uses_gradient && result > 0) return Status::converged;
    if (result == NLOPT_INVALID_ARGS) return Status::bad_input;
    // The methods that use no derivatives end like this, and line searches that find nothing lower.
    return Status::stalled_at_roundoff;
  }

  // Nothing to be gained but by leaving the bounds: the slope is small beside the steepest one met,
  // or Newton's step from here is about as short as the tolerance asked for. This one evaluation is
  // ours and not on the solver's account.
  bool is_minimum() const {
    constexpr double flat = 1e-6;
    constexpr double slack = 10.0;  // the backends bound their last step, not the error
    Vector slope(problem_.dimension());
    Matrix curvature(problem_.dimension(), problem_.dimension());
    problem_.evaluate(solution_.x.data(), slope.data(), curvature.data());
    if (!slope.allFinite() || !curvature.allFinite()) return false;
    for (int i = 0; i < problem_.dimension(); ++i) {
      if (!pushes_outwards(i, slope[i])) continue;
      slope[i] = 0.0;
      curvature.row(i).setZero();
      curvature.col(i).setZero();
      curvature(i, i) = 1.0;
    }
    if (slope.norm() <= flat * steepest_) return true;
    const Eigen::LLT<Matrix> factor(curvature);
    return factor.info() == Eigen::Success &&
           factor.solve(slope).norm() <= slack * options_.x_tolerance_m;
  }

  bool pushes_outwards(int i, double slope) const {
    if (!problem_.lower) return false;
    const double below = solution_.x[i] - (*problem_.lower)[i];
    const double above = (*problem_.upper)[i] - solution_.x[i];
    return (below <= 0.0 && slope >= 0.0) || (above <= 0.0 && slope <= 0.0);
  }

  const Problem& problem_;
  const Algorithm& algorithm_;
  const NloptOptions& options_;
  std::vector<int> free_;
  Vector point_;
  Solution solution_;
  nlopt_opt backend_ = nullptr;
  std::exception_ptr failure_;
  bool met_nan_ = false;
  bool out_of_budget_ = false;
  double steepest_ = 0.0;
};

class Nlopt final : public Solver {
 public:
  Nlopt(const Algorithm& algorithm, const NloptOptions& options)
      : algorithm_(algorithm), options_(options) {}

  Solution solve(const Problem& problem) const override {
    const auto begin = std::chrono::steady_clock::now();
    Solution solution;
    if (const char* wrong = flaw(problem)) {
      solution.x.setConstant(problem.start.size(), std::numeric_limits<double>::quiet_NaN());
      solution.backend_says = wrong;
    } else {
      solution = Run(problem, algorithm_, options_).solve();
    }
    solution.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return solution;
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.dimension() >= algorithm_.least_unknowns) return std::nullopt;
    return "needs at least " + std::to_string(algorithm_.least_unknowns) + " unknowns";
  }

 private:
  const Algorithm& algorithm_;
  NloptOptions options_;
};

const bool enrolled = [] {
  for (const Algorithm& algorithm : algorithms) {
    Enrol<Solver, NloptOptions>(algorithm.name, algorithm.summary,
                                [&algorithm](const NloptOptions& options) {
                                  return std::make_unique<Nlopt>(algorithm, options);
                                });
  }
  return true;
}();

}  // namespace
}  // namespace shoal::solvers
