// What the solver layer adds to its backends: the same cost, the same options, with and without it.

#include <benchmark/benchmark.h>
#include <ceres/ceres.h>
#include <nlopt.h>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/bench/two_neighbours.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

constexpr double x_tolerance_m = 1e-4;
constexpr int max_evaluations = 200;

Problem two_neighbours() {
  return Problem(Vector2d(0, 0), differentiated<2>(bench::TwoNeighbours{}));
}

/// A place among twelve that neighbours imply.
struct Places {
  static constexpr int block_size = 2;
  int blocks() const { return 12; }
  template <class T>
  void operator()(int block, const T* x, T* r) const {
    r[0] = x[0] - (10.0 + 3.0 * block);
    r[1] = x[1] - (5.0 * block * (block % 3) - 20.0);
  }
};

void layer(benchmark::State& state, const char* name, const Problem& problem) {
  const auto solver = Registry<Solver>::instance().make(name, Setting{}, name);
  for (auto _ : state) {
    const Solution solution = solver->solve(problem);
    benchmark::DoNotOptimize(solution.cost);
    state.counters["evaluations"] = solution.evaluations;
  }
}

/// What the layer calls, too: a cost of which the caller knows no more than that it is one. A
/// function that the compiler knew it would inline here, and leave out the Hessian.
double (*volatile evaluated)(const Problem& problem, const double* x, double* gradient) =
    [](const Problem& problem, const double* x, double* gradient) {
      return problem.evaluate(x, gradient);
    };

struct Raw {
  Problem problem = two_neighbours();
  int evaluations = 0;
};

double called_back(unsigned, const double* x, double* gradient, void* data) {
  Raw& raw = *static_cast<Raw*>(data);
  ++raw.evaluations;
  return evaluated(raw.problem, x, gradient);
}

void raw_nlopt(benchmark::State& state, nlopt_algorithm algorithm) {
  Raw raw;
  for (auto _ : state) {
    raw.evaluations = 0;
    nlopt_opt backend = nlopt_create(algorithm, 2);
    nlopt_set_min_objective(backend, called_back, &raw);
    nlopt_set_maxeval(backend, max_evaluations);
    nlopt_set_xtol_abs1(backend, x_tolerance_m);
    double x[2] = {0.0, 0.0}, cost = 0.0;
    nlopt_optimize(backend, x, &cost);
    nlopt_destroy(backend);
    benchmark::DoNotOptimize(cost);
  }
  state.counters["evaluations"] = raw.evaluations;
}

class RawCost final : public ceres::FirstOrderFunction {
 public:
  explicit RawCost(Raw& raw) : raw_(raw) {}
  int NumParameters() const override { return 2; }
  bool Evaluate(const double* x, double* cost, double* gradient) const override {
    ++raw_.evaluations;
    *cost = evaluated(raw_.problem, x, gradient);
    return true;
  }

 private:
  Raw& raw_;
};

struct RawShortStep final : ceres::IterationCallback {
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    return iteration.iteration > 0 && iteration.step_norm <= x_tolerance_m
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }
};

template <class Options>
void set_like_the_layer(Options& options, RawShortStep& short_step) {
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = max_evaluations;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0.0;
  options.callbacks.push_back(&short_step);
}

void raw_ceres_lbfgs(benchmark::State& state) {
  Raw raw;
  for (auto _ : state) {
    raw.evaluations = 0;
    const ceres::GradientProblem posed(new RawCost(raw));
    ceres::GradientProblemSolver::Options options;
    RawShortStep short_step;
    set_like_the_layer(options, short_step);
    ceres::GradientProblemSolver::Summary summary;
    double x[2] = {0.0, 0.0};
    ceres::Solve(options, posed, x, &summary);
    benchmark::DoNotOptimize(summary.final_cost);
  }
  state.counters["evaluations"] = raw.evaluations;
}

class RawBlock final : public ceres::SizedCostFunction<2, 2> {
 public:
  RawBlock(const VectorFunction& places, int block) : places_(places), block_(block) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    places_.evaluate(block_, x[0], residuals, jacobians ? jacobians[0] : nullptr, nullptr);
    return true;
  }

 private:
  const VectorFunction& places_;
  int block_;
};

void raw_ceres_least_squares(benchmark::State& state) {
  const auto places = differentiated_blocks<2>(Places{});
  const auto cauchy = Registry<Loss>::instance().make("cauchy", Setting{}, "cauchy");
  struct RawLoss final : ceres::LossFunction {
    const Loss* loss = nullptr;
    void Evaluate(double squared, double rho[3]) const override {
      const LossValue value = loss->at(squared);
      rho[0] = value.value;
      rho[1] = value.slope;
      rho[2] = value.curvature;
    }
  };
  for (auto _ : state) {
    double x[2] = {0.0, 0.0};
    ceres::Problem posed;
    for (int block = 0; block < places->blocks(); ++block) {
      auto* loss = new RawLoss;
      loss->loss = cauchy.get();
      posed.AddResidualBlock(new RawBlock(*places, block), loss, x);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    RawShortStep short_step;
    set_like_the_layer(options, short_step);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &posed, &summary);
    benchmark::DoNotOptimize(summary.final_cost);
  }
}

Problem robust_place() {
  return least_squares_problem(Vector2d::Zero(),
                               {differentiated_blocks<2>(Places{}),
                                Registry<Loss>::instance().make("cauchy", Setting{}, "cauchy"),
                                {}});
}

BENCHMARK_CAPTURE(layer, newton, "newton", two_neighbours());
BENCHMARK_CAPTURE(raw_nlopt, lbfgs, NLOPT_LD_LBFGS);
BENCHMARK_CAPTURE(layer, nlopt.lbfgs, "nlopt.lbfgs", two_neighbours());
BENCHMARK_CAPTURE(raw_nlopt, slsqp, NLOPT_LD_SLSQP);
BENCHMARK_CAPTURE(layer, nlopt.slsqp, "nlopt.slsqp", two_neighbours());
BENCHMARK_CAPTURE(raw_nlopt, neldermead, NLOPT_LN_NELDERMEAD);
BENCHMARK_CAPTURE(layer, nlopt.neldermead, "nlopt.neldermead", two_neighbours());
BENCHMARK(raw_ceres_lbfgs);
BENCHMARK_CAPTURE(layer, ceres.lbfgs, "ceres.lbfgs", two_neighbours());
BENCHMARK(raw_ceres_least_squares);
BENCHMARK_CAPTURE(layer, ceres.least_squares, "ceres.least_squares", robust_place());

}  // namespace
}  // namespace shoal::solvers
