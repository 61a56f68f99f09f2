#pragma once

#include <cstdint>

#include "shoal/solvers/smooth/limits.hpp"
#include "shoal/solvers/solver.hpp"

/// The methods of NLopt, each a type of its own.
namespace shoal::solvers::nlopt {

/// For methods that follow the gradient from the start.
template <class Method>
struct Following {
  std::int64_t max_evaluations = 200;
  double x_tolerance_m = 1e-4;

  static void declare(Options<Following>& o) { declare_limits(o); }
};

template <class Probing>
void declare_probing(Options<Probing>& o) {
  declare_limits(o);
  o.number("initial_step_m", &Probing::initial_step_m, "m", above(0.0), "first step");
}

/// For methods that use no derivatives and probe the surroundings instead.
template <class Method>
struct Probing {
  std::int64_t max_evaluations = 1000;
  double x_tolerance_m = 1e-4;
  double initial_step_m = 1.0;

  static void declare(Options<Probing>& o) { declare_probing(o); }
};

template <class Drawing>
void declare_seed(Options<Drawing>& o) {
  o.integer("seed", &Drawing::seed, "", in(0, 4294967295.0),
            "of the random numbers that the method draws");
}

/// The same, with random numbers.
template <class Method>
struct ProbingAtRandom {
  std::int64_t max_evaluations = 1000;
  double x_tolerance_m = 1e-4;
  double initial_step_m = 1.0;
  std::int64_t seed = 1;

  static void declare(Options<ProbingAtRandom>& o) {
    declare_probing(o);
    declare_seed(o);
  }
};

template <class Global>
void declare_global(Options<Global>& o) {
  declare_limits(o);
  o.integer("polish_evaluations", &Global::polish_evaluations, "", in(0, 1e9),
            "kept of the budget (up to half of it) to go from the best point found to the nearest "
            "minimum, by SLSQP: the methods for a whole box come close, and no closer");
}

/// For methods that search the whole box. Multi-level single linkage compares every start with all
/// before: its time grows as their square, and it has a smaller budget.
template <class Method, std::int64_t budget = 20'000>
struct Global {
  std::int64_t max_evaluations = budget;
  double x_tolerance_m = 1e-4;
  std::int64_t polish_evaluations = 100;

  static void declare(Options<Global>& o) { declare_global(o); }
};

/// The same, with random numbers.
template <class Method>
struct GlobalAtRandom {
  std::int64_t max_evaluations = 20'000;
  double x_tolerance_m = 1e-4;
  std::int64_t polish_evaluations = 100;
  std::int64_t seed = 1;

  static void declare(Options<GlobalAtRandom>& o) {
    declare_global(o);
    declare_seed(o);
  }
};

using Lbfgs = Following<struct LbfgsMethod>;
using Slsqp = Following<struct SlsqpMethod>;
using Mma = Following<struct MmaMethod>;
using Ccsaq = Following<struct CcsaqMethod>;
using TruncatedNewton = Following<struct TruncatedNewtonMethod>;
using VariableMetric = Following<struct VariableMetricMethod>;
using Bobyqa = Probing<struct BobyqaMethod>;
using Cobyla = Probing<struct CobylaMethod>;
using NelderMead = Probing<struct NelderMeadMethod>;
using Subplex = Probing<struct SubplexMethod>;
using Praxis = ProbingAtRandom<struct PraxisMethod>;
using DirectL = Global<struct DirectLMethod>;
using Crs2 = GlobalAtRandom<struct Crs2Method>;
using Isres = GlobalAtRandom<struct IsresMethod>;
using Mlsl = Global<struct MlslMethod, 2000>;
using Stogo = Global<struct StogoMethod>;

}  // namespace shoal::solvers::nlopt
