#include "shoal/solvers/smooth/nlopt.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;

struct Algorithm {
  const char* name;
  const char* summary;
  nlopt_algorithm id;
  bool takes_constraints = false;
  bool takes_equalities = false;
  int least_unknowns = 1;
};

template <class Method>
constexpr bool searches_a_box = requires(const Method& method) {
  method.polish_evaluations;
};

/// One solve: NLopt on one side, the attempt on the other.
template <class Method>
class Run {
 public:
  Run(Attempt& attempt, const Algorithm& algorithm, const Method& options)
      : attempt_(attempt), algorithm_(algorithm), options_(options) {}

  Solution solve() {
    nlopt_result result{};
    if constexpr (searches_a_box<Method>) {
      double cost_at_start = 0.0;  // at which these methods need not look by themselves
      attempt_.evaluate(attempt_.start().data(), cost_at_start);
      const std::int64_t kept = std::min(options_.polish_evaluations, options_.max_evaluations / 2);
      result = minimise(algorithm_.id, attempt_.start(), options_.max_evaluations - kept);
      if (kept > 0 && attempt_.best().allFinite()) {
        result = minimise(NLOPT_LD_SLSQP, attempt_.best(), options_.max_evaluations);
      }
    } else {
      result = minimise(algorithm_.id, attempt_.start(), options_.max_evaluations);
    }
    const char* says = nlopt_result_to_string(result);
    return attempt_.finish(static_cast<int>(result), says ? says : "");
  }

 private:
  static constexpr bool steps_along_lines =
      !searches_a_box<Method> && !requires(const Method& method) {
    method.initial_step_m;
  };
  using Handle = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

  nlopt_result minimise(nlopt_algorithm id, Vector x, std::int64_t evaluations) {
    const Handle owner = made(id, evaluations);
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
    if (algorithm_.takes_equalities && attempt_.equalities() > 0) {
      nlopt_add_equality_mconstraint(backend_, static_cast<unsigned>(attempt_.equalities()),
                                     &Run::equalities, this, nullptr);
    }
    if (id == NLOPT_GD_MLSL_LDS) {
      const Handle local = made(NLOPT_LD_LBFGS, evaluations);
      nlopt_set_local_optimizer(backend_, local.get());
    }
    // What is drawn belongs to this solve: the same problem shall give the same answer.
    if constexpr (requires { options_.seed; }) {
      nlopt_srand(static_cast<unsigned long>(options_.seed));
    }
    double lowest = 0.0;
    return nlopt_optimize(backend_, x.data(), &lowest);
  }

  Handle made(nlopt_algorithm id, std::int64_t evaluations) const {
    Handle handle(nlopt_create(id, static_cast<unsigned>(attempt_.unknowns())), &nlopt_destroy);
    if (!handle) throw std::bad_alloc();
    nlopt_set_maxeval(handle.get(), static_cast<int>(evaluations));
    // Methods that step along a line end where no unknown moves by more than NLopt's tolerance: of
    // many unknowns, each may move by little far from the minimum. (Of two, as vehicles have, none
    // does.)
    const double share = steps_along_lines ? std::min(1.0, 2.0 / attempt_.unknowns()) : 1.0;
    nlopt_set_xtol_abs1(handle.get(), share * options_.x_tolerance_m);
    if constexpr (requires { options_.initial_step_m; }) {
      nlopt_set_initial_step1(handle.get(), options_.initial_step_m);
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

  static void equalities(unsigned count, double* values, unsigned unknowns, const double* y,
                         double* gradients, void* self) {
    Run& run = *static_cast<Run*>(self);
    for (unsigned k = 0; k < count; ++k) {
      double* gradient = gradients ? gradients + std::size_t{k} * unknowns : nullptr;
      const int which = run.attempt_.constraints() + static_cast<int>(k);
      const auto outcome = run.attempt_.constrain(which, y, values[k], gradient);
      if (outcome != Attempt::Outcome::fine) values[k] = run.substitute(outcome, gradient);
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
  const Method& options_;
  nlopt_opt backend_ = nullptr;
};

template <class Method>
class NloptSolver final : public Solver {
 public:
  NloptSolver(const Algorithm& algorithm, const Method& options)
      : algorithm_(algorithm), options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, Limits::of(options_));
    if (!attempt.open()) return attempt.finish(0, "");
    return Run<Method>(attempt, algorithm_, options_).solve();
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constraints && !algorithm_.takes_constraints) return "takes no constraints";
    if (problem.equalities && !algorithm_.takes_equalities) return "takes no equalities";
    if (searches_a_box<Method> && !(problem.lower && problem.upper)) {
      return "needs bounds: it searches the whole box";
    }
    if (searches_a_box<Method> && !(problem.lower->allFinite() && problem.upper->allFinite())) {
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

  Algorithm algorithm_;
  Method options_;
};

template <class Method>
void add(const Algorithm& algorithm) {
  Register<Solver, Method>(algorithm.name, algorithm.summary, [algorithm](const Method& options) {
    return std::make_unique<NloptSolver<Method>>(algorithm, options);
  });
}

const bool registered = [] {
  add<nlopt::Lbfgs>(
      {.name = "nlopt.lbfgs", .summary = "NLopt: limited-memory BFGS", .id = NLOPT_LD_LBFGS});
  add<nlopt::Slsqp>({.name = "nlopt.slsqp",
                     .summary = "NLopt: sequential quadratic programming",
                     .id = NLOPT_LD_SLSQP,
                     .takes_constraints = true,
                     .takes_equalities = true});
  add<nlopt::Mma>({.name = "nlopt.mma",
                   .summary = "NLopt: method of moving asymptotes",
                   .id = NLOPT_LD_MMA,
                   .takes_constraints = true});
  add<nlopt::Ccsaq>({.name = "nlopt.ccsaq",
                     .summary = "NLopt: conservative convex separable quadratic approximations",
                     .id = NLOPT_LD_CCSAQ,
                     .takes_constraints = true});
  add<nlopt::TruncatedNewton>(
      {.name = "nlopt.tnewton", .summary = "NLopt: truncated Newton", .id = NLOPT_LD_TNEWTON});
  add<nlopt::VariableMetric>(
      {.name = "nlopt.var2", .summary = "NLopt: variable metric, rank 2", .id = NLOPT_LD_VAR2});
  add<nlopt::Bobyqa>(
      {.name = "nlopt.bobyqa",
       .summary = "NLopt: quadratic models without derivatives (used by Rypkema 2015)",
       .id = NLOPT_LN_BOBYQA,
       .least_unknowns = 2});
  add<nlopt::Cobyla>({.name = "nlopt.cobyla",
                      .summary = "NLopt: linear models without derivatives",
                      .id = NLOPT_LN_COBYLA,
                      .takes_constraints = true,
                      .takes_equalities = true});
  add<nlopt::NelderMead>({.name = "nlopt.neldermead",
                          .summary = "NLopt: Nelder-Mead simplex",
                          .id = NLOPT_LN_NELDERMEAD});
  add<nlopt::Subplex>({.name = "nlopt.sbplx",
                       .summary = "NLopt: Subplex, simplices on subspaces",
                       .id = NLOPT_LN_SBPLX});
  add<nlopt::Praxis>({.name = "nlopt.praxis",
                      .summary = "NLopt: principal axes, without derivatives",
                      .id = NLOPT_LN_PRAXIS});
  add<nlopt::DirectL>({.name = "nlopt.direct_l",
                       .summary = "NLopt: dividing rectangles, in a box",
                       .id = NLOPT_GN_DIRECT_L});
  add<nlopt::Crs2>({.name = "nlopt.crs2",
                    .summary = "NLopt: controlled random search with local mutation, in a box",
                    .id = NLOPT_GN_CRS2_LM});
  add<nlopt::Isres>({.name = "nlopt.isres",
                     .summary = "NLopt: evolution strategy with stochastic ranking, in a box",
                     .id = NLOPT_GN_ISRES,
                     .takes_constraints = true,
                     .takes_equalities = true});
  add<nlopt::Mlsl>({.name = "nlopt.mlsl",
                    .summary = "NLopt: L-BFGS from low-discrepancy starts, in a box",
                    .id = NLOPT_GD_MLSL_LDS});
  add<nlopt::Stogo>({.name = "nlopt.stogo",
                     .summary = "NLopt: branch and bound with local searches, in a box",
                     .id = NLOPT_GD_STOGO});
  return true;
}();

}  // namespace
}  // namespace shoal::solvers
