#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;

struct LocalOptions : Limits {
  static constexpr std::int64_t seed = 1;
  double initial_step_m = 1.0;

  static void declare(Options<LocalOptions>& o) { declare_limits(o); }
};

/// For methods that use no derivatives and probe the surroundings instead.
struct ProbingOptions : LocalOptions {
  ProbingOptions() { max_evaluations = 1000; }

  static void declare(Options<ProbingOptions>& o) {
    declare_limits(o);
    o.number("initial_step_m", &ProbingOptions::initial_step_m, "m", above(0.0), "first step");
  }
};

struct GlobalOptions : GlobalLimits {
  std::int64_t seed = 1;
  std::int64_t polish_evaluations = 100;
  double initial_step_m = 1.0;

  static void declare(Options<GlobalOptions>& o) { declare_global(o); }

  template <class Declared>
  static void declare_global(Options<Declared>& o) {
    declare_limits(o);
    o.integer("seed", &Declared::seed, "", in(0, 4294967295.0),
              "of the random numbers that the method draws (if it draws any)");
    o.integer(
        "polish_evaluations", &Declared::polish_evaluations, "", in(0, 1e9),
        "kept of the budget (up to half of it) to go from the best point found to the nearest "
        "minimum, by SLSQP: the methods for a whole box come close, and no closer");
  }
};

/// Multi-level single linkage compares every start with all before: its time grows as their square.
struct LinkageOptions : GlobalOptions {
  LinkageOptions() { max_evaluations = 2000; }

  static void declare(Options<LinkageOptions>& o) { declare_global(o); }
};

struct Algorithm {
  const char* name;
  nlopt_algorithm id;
  bool uses_gradient;
  bool takes_constraints;
  bool global;
  bool draws;  // random numbers
  int least_unknowns;
  const char* summary;
};

constexpr std::array algorithms{
    Algorithm{"nlopt.lbfgs", NLOPT_LD_LBFGS, true, false, false, false, 1,
              "NLopt: limited-memory BFGS"},
    Algorithm{"nlopt.slsqp", NLOPT_LD_SLSQP, true, true, false, false, 1,
              "NLopt: sequential quadratic programming"},
    Algorithm{"nlopt.mma", NLOPT_LD_MMA, true, true, false, false, 1,
              "NLopt: method of moving asymptotes"},
    Algorithm{"nlopt.ccsaq", NLOPT_LD_CCSAQ, true, true, false, false, 1,
              "NLopt: conservative convex separable quadratic approximations"},
    Algorithm{"nlopt.tnewton", NLOPT_LD_TNEWTON, true, false, false, false, 1,
              "NLopt: truncated Newton"},
    Algorithm{"nlopt.var2", NLOPT_LD_VAR2, true, false, false, false, 1,
              "NLopt: variable metric, rank 2"},
    Algorithm{"nlopt.bobyqa", NLOPT_LN_BOBYQA, false, false, false, false, 2,
              "NLopt: quadratic models without derivatives (used by Rypkema 2015)"},
    Algorithm{"nlopt.cobyla", NLOPT_LN_COBYLA, false, true, false, false, 1,
              "NLopt: linear models without derivatives"},
    Algorithm{"nlopt.neldermead", NLOPT_LN_NELDERMEAD, false, false, false, false, 1,
              "NLopt: Nelder-Mead simplex"},
    Algorithm{"nlopt.sbplx", NLOPT_LN_SBPLX, false, false, false, false, 1,
              "NLopt: Subplex, simplices on subspaces"},
    Algorithm{"nlopt.praxis", NLOPT_LN_PRAXIS, false, false, false, true, 1,
              "NLopt: principal axes, without derivatives"},
    Algorithm{"nlopt.direct_l", NLOPT_GN_DIRECT_L, false, false, true, false, 1,
              "NLopt: dividing rectangles, in a box"},
    Algorithm{"nlopt.crs2", NLOPT_GN_CRS2_LM, false, false, true, true, 1,
              "NLopt: controlled random search with local mutation, in a box"},
    Algorithm{"nlopt.isres", NLOPT_GN_ISRES, false, true, true, true, 1,
              "NLopt: evolution strategy with stochastic ranking, in a box"},
    Algorithm{"nlopt.mlsl", NLOPT_GD_MLSL_LDS, true, false, true, true, 1,
              "NLopt: L-BFGS from low-discrepancy starts, in a box"},
    Algorithm{"nlopt.stogo", NLOPT_GD_STOGO, true, false, true, false, 1,
              "NLopt: branch and bound with local searches, in a box"},
};

/// One solve: NLopt on one side, the attempt on the other.
class Run {
 public:
  Run(Attempt& attempt, const Algorithm& algorithm) : attempt_(attempt), algorithm_(algorithm) {}

  template <class SomeOptions>
  Solution solve(const SomeOptions& options) {
    std::int64_t kept = 0;
    if constexpr (requires { options.polish_evaluations; }) {
      kept = std::min(options.polish_evaluations, options.max_evaluations / 2);
    }
    if (algorithm_.global) {  // which need not look at the start by themselves
      double cost_at_start = 0.0;
      attempt_.evaluate(attempt_.start().data(), cost_at_start);
    }
    nlopt_result result = minimise(algorithm_.id, attempt_.start(), options, kept);
    if (kept > 0 && attempt_.best().allFinite()) {
      result = minimise(NLOPT_LD_SLSQP, attempt_.best(), options, 0);
    }
    const char* says = nlopt_result_to_string(result);
    return attempt_.finish(static_cast<int>(result), says ? says : "");
  }

 private:
  using Handle = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

  template <class SomeOptions>
  nlopt_result minimise(nlopt_algorithm id, Vector x, const SomeOptions& options,
                        std::int64_t kept) {
    const std::int64_t evaluations = options.max_evaluations - kept;
    const Handle owner = made(id, options, evaluations);
    backend_ = owner.get();
    nlopt_set_min_objective(backend_, &Run::cost, this);
    if (attempt_.bounded()) {
      nlopt_set_lower_bounds(backend_, attempt_.lower().data());
      nlopt_set_upper_bounds(backend_, attempt_.upper().data());
    }
    if (algorithm_.takes_constraints && attempt_.constraints() > 0) {
      nlopt_add_inequality_mconstraint(backend_, static_cast<unsigned>(attempt_.constraints()),
                                       &Run::constraints, this, nullptr);
    }
    if (id == NLOPT_GD_MLSL_LDS) {
      const Handle local = made(NLOPT_LD_LBFGS, options, evaluations);
      nlopt_set_local_optimizer(backend_, local.get());
    }
    // What is drawn belongs to this solve: the same problem shall give the same answer.
    if (algorithm_.draws) nlopt_srand(static_cast<unsigned long>(options.seed));
    double lowest = 0.0;
    return nlopt_optimize(backend_, x.data(), &lowest);
  }

  template <class SomeOptions>
  Handle made(nlopt_algorithm id, const SomeOptions& options, std::int64_t evaluations) const {
    Handle handle(nlopt_create(id, static_cast<unsigned>(attempt_.unknowns())), &nlopt_destroy);
    if (!handle) throw std::bad_alloc();
    nlopt_set_maxeval(handle.get(), static_cast<int>(evaluations));
    nlopt_set_xtol_abs1(handle.get(), options.x_tolerance_m);
    if (!algorithm_.uses_gradient && !algorithm_.global) {
      nlopt_set_initial_step1(handle.get(), options.initial_step_m);
    }
    return handle;
  }

  // NLopt is C: no exception may pass.
  static double cost(unsigned, const double* y, double* gradient, void* self) {
    Run& run = *static_cast<Run*>(self);
    double value = 0.0;
    const Attempt::Outcome outcome = run.attempt_.evaluate(y, value, gradient);
    return outcome == Attempt::Outcome::fine ? value : run.substitute(outcome, gradient);
  }

  static void constraints(unsigned count, double* values, unsigned unknowns, const double* y,
                          double* gradients, void* self) {
    Run& run = *static_cast<Run*>(self);
    for (unsigned k = 0; k < count; ++k) {
      double* gradient = gradients ? gradients + std::size_t{k} * unknowns : nullptr;
      const auto outcome = run.attempt_.constrain(static_cast<int>(k), y, values[k], gradient);
      if (outcome != Attempt::Outcome::fine) values[k] = -run.substitute(outcome, gradient);
      values[k] = -values[k];  // NLopt's constraints are g <= 0
      for (unsigned i = 0; gradient && i < unknowns; ++i) gradient[i] = -gradient[i];
    }
  }

  // Where there is no cost, a high one sends the methods elsewhere; the judgement does not forget.
  // It has to be finite: on infinities COBYLA may circle in its linear model without a call back.
  double substitute(Attempt::Outcome outcome, double* gradient) {
    const bool any = std::isfinite(attempt_.worst_cost());
    if (outcome == Attempt::Outcome::stop || !any) nlopt_force_stop(backend_);
    for (int k = 0; gradient && k < attempt_.unknowns(); ++k) gradient[k] = 0.0;
    return any ? attempt_.worst_cost() : 0.0;
  }

  Attempt& attempt_;
  const Algorithm& algorithm_;
  nlopt_opt backend_ = nullptr;
};

template <class SomeOptions>
class Nlopt final : public Solver {
 public:
  Nlopt(const Algorithm& algorithm, const SomeOptions& options)
      : algorithm_(algorithm), options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, options_);
    if (!attempt.open()) return attempt.finish(0, "");
    return Run(attempt, algorithm_).solve(options_);
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constraints && !algorithm_.takes_constraints) return "takes no constraints";
    if (algorithm_.global && !(problem.lower && problem.upper)) {
      return "needs bounds: it searches the whole box";
    }
    if (algorithm_.global && !(problem.lower->allFinite() && problem.upper->allFinite())) {
      return "needs finite bounds: it searches the whole box";
    }
    const int unknowns = free_unknowns(problem);
    if (unknowns > 0 && unknowns < algorithm_.least_unknowns) {
      return "needs at least two unknowns that are not fixed by their bounds";
    }
    return std::nullopt;
  }

 private:
  static int free_unknowns(const Problem& problem) {
    if (!problem.lower || !problem.upper || problem.lower->size() != problem.upper->size()) {
      return problem.dimension();
    }
    return static_cast<int>((problem.lower->array() != problem.upper->array()).count());
  }

  const Algorithm& algorithm_;
  SomeOptions options_;
};

template <class SomeOptions>
void enrol(const Algorithm& algorithm) {
  Enrol<Solver, SomeOptions>(algorithm.name, algorithm.summary,
                             [&algorithm](const SomeOptions& options) {
                               return std::make_unique<Nlopt<SomeOptions>>(algorithm, options);
                             });
}

const bool enrolled = [] {
  for (const Algorithm& algorithm : algorithms) {
    if (algorithm.id == NLOPT_GD_MLSL_LDS) {
      enrol<LinkageOptions>(algorithm);
    } else if (algorithm.global) {
      enrol<GlobalOptions>(algorithm);
    } else if (algorithm.uses_gradient) {
      enrol<LocalOptions>(algorithm);
    } else {
      enrol<ProbingOptions>(algorithm);
    }
  }
  return true;
}();

}  // namespace
}  // namespace shoal::solvers
