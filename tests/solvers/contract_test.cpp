// What every solver of smooth problems promises, whatever stands behind it: a new one is tested by
// being registered.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/support/nan_value.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using shoal::tests::nan_value;

// (x - 3)^2 + 2 (y + 2)^2, as residuals, so that all solvers take it.
struct Bowl {
  static constexpr int block_size = 1;
  int blocks() const { return 2; }
  template <class T>
  void operator()(int block, const T* p, T* r) const {
    r[0] = block == 0 ? p[0] - 3.0 : std::sqrt(2.0) * (p[1] + 2.0);
  }
};

// NaN where x > 1, on the way from (0, 0) to the lowest point.
struct BowlBehindABand : Bowl {
  template <class T>
  void operator()(int block, const T* p, T* r) const {
    Bowl::operator()(block, p, r);
    if (p[0] > T(1.0)) r[0] = r[0] * nan_value;
  }
};

struct Nowhere : Bowl {
  template <class T>
  void operator()(int, const T* p, T* r) const {
    r[0] = p[0] * nan_value;
  }
};

struct MyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ThrowsAway : Bowl {
  template <class T>
  void operator()(int block, const T* p, T* r) const {
    if (p[0] > T(0.5)) throw MyError("no cost east of 0.5");
    Bowl::operator()(block, p, r);
  }
};

/// Derivatives of the wrong sign: a mistake that must not end as "converged".
class WrongSign final : public VectorFunction {
 public:
  int blocks() const override { return 2; }
  int block_size() const override { return 1; }
  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    right_->evaluate(block, x, values, jacobian, hessians);
    for (int i = 0; jacobian && i < 2; ++i) jacobian[i] = -jacobian[i];
    for (int i = 0; hessians && i < 4; ++i) hessians[i] = -hessians[i];
  }

 private:
  std::shared_ptr<const VectorFunction> right_ = differentiated_blocks<2>(Bowl{});
};

// A solve whose cost solves another problem, as for a formation within a formation.
struct Nested : Bowl {
  const Solver* solver;
  const Problem* inner;
  double lowest;
  explicit Nested(const Solver* s, const Problem* p, double l) : solver(s), inner(p), lowest(l) {}
  template <class T>
  void operator()(int block, const T* p, T* r) const {
    Bowl::operator()(block, p, r);
    const Solution solution = solver->solve(*inner);
    if (solution.cost != lowest) throw std::logic_error("the inner solve gave something else");
  }
};

// Costs that backends have been seen to circle on.
struct Rough {
  double scale, roughness;
  int kind;
  template <class T>
  T operator()(const T* x) const {
    T cost = x[0] * x[0] + 0.5 * x[1] * x[1];
    if (kind == 1) cost = cost + roughness * sin(37.0 * x[0]) * cos(29.0 * x[1]);
    if (kind == 2) cost = abs(x[0] - 1.0) + roughness * abs(x[1] + x[0]);
    if (kind == 3) cost = T(1.0);
    if (kind == 4) cost = x[0] * 3.0;
    if (kind == 5) cost = exp(30.0 * abs(x[0])) + x[1];
    return scale * cost;
  }
};

// 1 / r^2 + 2 r: infinite at the origin, lowest on the unit circle.
struct Pole {
  template <class T>
  T operator()(const T* x) const {
    using std::sqrt;
    const T squared = x[0] * x[0] + x[1] * x[1];
    return 1.0 / squared + 2.0 * sqrt(squared);
  }
};

class EverySolver : public testing::TestWithParam<std::string> {
 protected:
  static std::unique_ptr<Solver> make(const Setting& options = {}) {
    return Registry<Solver>::instance().make(GetParam(), options, "solver." + GetParam());
  }

  static Setting budget(std::int64_t evaluations) {
    Setting options;
    options.at_or_new("max_evaluations").value = evaluations;
    return options;
  }

  /// Multistart's budget is that of its solver.
  static bool has_budget() {
    const auto& registry = Registry<Solver>::instance();
    const auto& member = registry.members()[registry.index_of(GetParam(), {}, "")];
    return member.schema().find("max_evaluations") != nullptr;
  }

  const std::unique_ptr<Solver> solver = make();

  /// As it stands for solvers that search from the start, in a box for those that search a box.
  Problem posed(Problem problem) const {
    if (!solver->refuses(problem)) return problem;
    problem.lower = Problem::Vector::Constant(problem.dimension(), -10.0);
    problem.upper = Problem::Vector::Constant(problem.dimension(), 9.0);
    EXPECT_EQ(solver->refuses(problem).value_or(""), "") << GetParam();
    return problem;
  }

  template <class Residuals>
  Problem problem_of(const Residuals& residuals, const Vector2d& start = {0, 0}) const {
    return posed(least_squares_problem(start, {differentiated_blocks<2>(residuals), nullptr, {}}));
  }
};

TEST_P(EverySolver, FindsTheLowestPointOfABowl) {
  const Solution solution = solver->solve(problem_of(Bowl{}));
  EXPECT_TRUE(solution.usable()) << solution.backend_says;
  EXPECT_NEAR((Vector2d(solution.x) - Vector2d(3, -2)).norm(), 0.0, 1e-2);
  EXPECT_GT(solution.evaluations, 0);
  EXPECT_EQ(solution.violation, 0.0);
}

TEST_P(EverySolver, DoesNotTakeTheEdgeOfANanBandForAMinimum) {
  const Problem problem = problem_of(BowlBehindABand{});
  const Solution solution = solver->solve(problem);
  EXPECT_EQ(name_of(solution.status), "diverged") << solution.backend_says;
  EXPECT_FALSE(solution.usable());
  EXPECT_TRUE(solution.x.allFinite());  // the best that it saw
  EXPECT_LE(solution.x[0], 1.0);
  EXPECT_EQ(solution.cost, problem.evaluate(solution.x.data()));
}

TEST_P(EverySolver, HasNoPointWhereThereIsNoFiniteCost) {
  const Solution solution = solver->solve(problem_of(Nowhere{}));
  EXPECT_EQ(name_of(solution.status), "diverged");
  EXPECT_TRUE(std::isnan(solution.cost));
  EXPECT_TRUE(std::isnan(solution.x[0]) && std::isnan(solution.x[1]));
}

// Ceres ends the process on such a loss where it meets it.
TEST_P(EverySolver, DoesNotTakeTheEdgeOfALossForAMinimum) {
  struct Broken final : Loss {
    LossValue at(double squared) const override {
      return squared < 6.0 ? LossValue{nan_value, nan_value, nan_value}
                           : LossValue{squared, 1.0, 0.0};
    }
  };
  const Problem problem = posed(least_squares_problem(
      Vector2d(0, 0), {differentiated_blocks<2>(Bowl{}), std::make_shared<Broken>(), {}}));
  const Solution solution = solver->solve(problem);
  EXPECT_EQ(name_of(solution.status), "diverged") << solution.backend_says;
}

TEST_P(EverySolver, LetsTheExceptionOfTheCostThroughUnchanged) {
  try {
    solver->solve(problem_of(ThrowsAway{}));
    ADD_FAILURE() << "swallowed the exception";
  } catch (const MyError& error) {
    EXPECT_STREQ(error.what(), "no cost east of 0.5");
  }
}

TEST_P(EverySolver, IsFitForUseAfterAnException) {
  EXPECT_THROW(solver->solve(problem_of(ThrowsAway{})), MyError);
  EXPECT_TRUE(solver->solve(problem_of(Bowl{})).usable());
}

TEST_P(EverySolver, AnswersAStartOrBoundsThatMakeNoSenseWithBadInput) {
  const auto refuse = [&](const Problem& problem, const char* what) {
    const Solution solution = solver->solve(problem);
    EXPECT_EQ(name_of(solution.status), "bad_input") << what;
    EXPECT_EQ(solution.evaluations, 0) << what;
    EXPECT_STRNE(solution.backend_says, "") << what;
    EXPECT_TRUE(solution.x.size() == 0 || std::isnan(solution.x[0])) << what;
  };
  refuse(problem_of(Bowl{}, {nan_value, 0}), "NaN in the start");
  refuse(problem_of(Bowl{}, {0, std::numeric_limits<double>::infinity()}), "infinite start");
  refuse(Problem(Problem::Vector(0), differentiated<2>([](const auto* x) { return x[0]; })),
         "no unknowns");
  Problem problem = problem_of(Bowl{});
  problem.upper.reset();
  problem.lower = Vector2d(-1, -1);
  refuse(problem, "half the bounds");
  problem.upper = Eigen::Vector3d(1, 1, 1);
  refuse(problem, "bounds of the wrong size");
  problem.upper = Vector2d(1, -2);
  refuse(problem, "crossed bounds");
  problem.upper = Vector2d(1, nan_value);
  refuse(problem, "NaN in the bounds");
  problem.upper = Vector2d(1, -0.5);
  refuse(problem, "a start outside the bounds");
}

TEST_P(EverySolver, StaysInsideTheBoundsOrSaysThatItTakesNone) {
  Problem problem = problem_of(Bowl{});
  problem.lower = Vector2d(-1, -1);
  problem.upper = Vector2d(1, 1);
  if (const auto why = solver->refuses(problem)) {
    EXPECT_EQ(*why, "takes no bounds");
    EXPECT_EQ(name_of(solver->solve(problem).status), "bad_input");
    return;
  }
  const Solution solution = solver->solve(problem);
  EXPECT_TRUE(solution.usable()) << name_of(solution.status) << ": " << solution.backend_says;
  EXPECT_NEAR((Vector2d(solution.x) - Vector2d(1, -1)).norm(), 0.0, 1e-2);
  EXPECT_LE(solution.x[0], 1.0);
  EXPECT_GE(solution.x[1], -1.0);
}

// A vehicle exactly on top of a neighbour.
TEST_P(EverySolver, MakesNothingUpWhereTheCostHasAPoleAtTheStart) {
  Problem problem(Vector2d(0, 0), differentiated<2>(Pole{}));
  if (const auto why = solver->refuses(problem); why && why->starts_with("needs residuals")) {
    GTEST_SKIP() << GetParam() << " " << *why;
  }
  problem = posed(problem);
  const Solution solution = solver->solve(problem);
  if (solution.usable()) {
    EXPECT_NEAR(solution.x.norm(), 1.0, 1e-2);
    EXPECT_EQ(solution.cost, problem.evaluate(solution.x.data()));
  } else {
    EXPECT_EQ(name_of(solution.status), "diverged");
  }
}

TEST_P(EverySolver, LeavesAnUnknownAloneWhoseBoundsAreEqual) {
  Problem problem = problem_of(Bowl{}, {0, 0.5});
  problem.lower = Vector2d(-10, 0.5);
  problem.upper = Vector2d(9, 0.5);
  if (const auto why = solver->refuses(problem)) {
    EXPECT_TRUE(*why == "takes no bounds" ||
                *why == "needs at least two unknowns that are not fixed by their bounds")
        << *why;
    return;
  }
  const Solution solution = solver->solve(problem);
  EXPECT_TRUE(solution.usable()) << solution.backend_says;
  EXPECT_NEAR(solution.x[0], 3.0, 1e-2);
  EXPECT_EQ(solution.x[1], 0.5);
}

TEST_P(EverySolver, AnswersWithTheStartWhenEverythingIsFixed) {
  Problem problem = problem_of(Bowl{}, {1, 1});
  problem.lower = problem.upper = Vector2d(1, 1);
  if (const auto why = solver->refuses(problem)) {
    EXPECT_EQ(*why, "takes no bounds");
    return;
  }
  const Solution solution = solver->solve(problem);
  EXPECT_EQ(name_of(solution.status), "converged");
  EXPECT_EQ(Vector2d(solution.x), Vector2d(1, 1));
  EXPECT_NEAR(solution.cost, 22.0, 1e-12);
}

TEST_P(EverySolver, KeepsToItsBudgetAndNeverEndsWorseThanItStarted) {
  if (!has_budget()) GTEST_SKIP() << GetParam() << " has the budget of its solver";
  const Problem problem = problem_of(Bowl{});
  const double at_start = problem.evaluate(problem.start.data());
  for (const int evaluations : {1, 2, 3, 7, 20}) {
    const Solution solution = make(budget(evaluations))->solve(problem);
    EXPECT_LE(solution.evaluations, evaluations);
    EXPECT_TRUE(solution.x.allFinite());
    EXPECT_TRUE(solution.status == Status::budget || solution.status == Status::converged)
        << name_of(solution.status);
    if (solver->refuses(least_squares_problem(Vector2d::Zero(),
                                              {differentiated_blocks<2>(Bowl{}), nullptr, {}}))) {
      continue;  // a search of the box need not begin at the start
    }
    EXPECT_LE(solution.cost, at_start);
  }
}

TEST_P(EverySolver, RefusesABudgetOfNothingAndAToleranceOfNothing) {
  if (!has_budget()) GTEST_SKIP() << GetParam() << " has the budget of its solver";
  EXPECT_THROW(make(budget(0)), InputError);
  EXPECT_THROW(make(budget(-5)), InputError);
  Setting options;
  options.at_or_new("x_tolerance_m").value = 0.0;
  EXPECT_THROW(make(options), InputError);
}

TEST_P(EverySolver, NamesTheKnownOptionsWhenOneIsUnknown) {
  Setting options;
  options.at_or_new("max_evalutions").value = std::int64_t{5};
  try {
    make(options);
    ADD_FAILURE() << "took an unknown option";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("has no option \"max_evalutions\""), std::string::npos) << text;
    EXPECT_TRUE(text.find("did you mean") != std::string::npos ||
                text.find("known are") != std::string::npos)
        << text;
  }
}

TEST_P(EverySolver, DoesNotCallAWrongGradientConverged) {
  const Problem problem =
      posed(least_squares_problem(Vector2d(5, 5), {std::make_shared<WrongSign>(), nullptr, {}}));
  const Solution solution = solver->solve(problem);
  if (solution.status == Status::converged) {  // those that use none may find the lowest point
    EXPECT_NEAR((Vector2d(solution.x) - Vector2d(3, -2)).norm(), 0.0, 1e-2);
  }
  EXPECT_LE(solution.cost, problem.evaluate(problem.start.data()));
}

TEST_P(EverySolver, StaysWhereItIsWhenItStartsAtTheMinimum) {
  const Solution solution = solver->solve(problem_of(Bowl{}, {3, -2}));
  EXPECT_TRUE(solution.usable()) << solution.backend_says;
  EXPECT_NEAR(solution.cost, 0.0, 1e-3);
}

TEST_P(EverySolver, MayBeUsedInsideACostThatItMinimises) {
  Setting options;
  if (has_budget()) options = budget(60);
  const auto small = make(options);
  const Problem inner = problem_of(Bowl{});
  const Solution alone = small->solve(inner);
  EXPECT_NO_THROW(small->solve(problem_of(Nested(small.get(), &inner, alone.cost))));
}

TEST_P(EverySolver, GivesTheSameBitsAgainAndInOtherThreads) {
  const Problem problem = problem_of(Bowl{});
  const Solution here = solver->solve(problem);
  const auto expect_same = [&](const Solution& other) {
    EXPECT_EQ(Vector2d(here.x), Vector2d(other.x));
    EXPECT_EQ(here.cost, other.cost);
    EXPECT_EQ(here.evaluations, other.evaluations);
    EXPECT_EQ(here.status, other.status);
  };
  expect_same(solver->solve(problem));
  std::vector<Solution> there(4);
  std::vector<std::thread> threads;
  for (Solution& solution : there) {
    threads.emplace_back([&] {
      for (int k = 0; k < 3; ++k) solution = solver->solve(problem);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Solution& solution : there) expect_same(solution);
}

// COBYLA of NLopt 2.7 has been seen to circle for ever in its linear model.
TEST_P(EverySolver, ReturnsFromRoughAndHugeAndTinyCosts) {
  Problem no_residuals(Vector2d(0, 0), differentiated<2>(Rough{1, 0, 0}));
  if (const auto why = solver->refuses(no_residuals); why && why->starts_with("needs residuals")) {
    GTEST_SKIP() << GetParam() << " " << *why;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-9.0, 8.0);
  Setting options;
  if (has_budget()) options = budget(GetParam() == "ipopt" ? 50 : 500);
  const auto impatient = make(options);
  const int rounds = GetParam() == "ipopt" || GetParam() == "multistart" ? 2 : 8;
  for (int round = 0; round < rounds; ++round) {
    for (const double scale : {1e-200, 1e-8, 1.0, 1e8, 1e200}) {
      for (int kind = 0; kind < 6; ++kind) {
        const Vector2d start(place(random), place(random));
        Problem problem(start, differentiated<2>(Rough{scale, place(random), kind}));
        const Solution solution = impatient->solve(posed(problem));
        EXPECT_TRUE(std::isfinite(solution.cost) || solution.status == Status::diverged);
      }
    }
  }
}

// A seed that changes nothing would be an option that does nothing.
TEST(SolversThatDraw, DrawOtherNumbersWithAnotherSeed) {
  const auto& registry = Registry<Solver>::instance();
  std::vector<std::string> drawing;
  for (const MemberInfo& member : registry.members()) {
    if (!member.schema().find("seed")) continue;
    drawing.push_back(member.name);
    Problem problem(Vector2d(5, 5), differentiated<2>(Rough{1.0, 0.5, 1}));
    problem.lower = Vector2d(-10, -10);
    problem.upper = Vector2d(9, 9);
    const auto evaluations = [&](std::int64_t seed) {
      Setting options;
      options.at_or_new("seed").value = seed;
      return registry.make(member.name, options, member.name)->solve(problem).evaluations;
    };
    EXPECT_EQ(evaluations(0), evaluations(0)) << member.name;
    bool any_other = false;
    for (std::int64_t seed = 1; seed < 6; ++seed) any_other |= evaluations(seed) != evaluations(0);
    EXPECT_TRUE(any_other) << member.name;
  }
  EXPECT_EQ(drawing,
            (std::vector<std::string>{"multistart", "nlopt.crs2", "nlopt.isres", "nlopt.praxis"}));
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver,
                         testing::ValuesIn(Registry<Solver>::instance().names()),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

}  // namespace
}  // namespace shoal::solvers
