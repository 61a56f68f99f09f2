// Registration by a smooth solver: with the square as the closed form has it, with robust losses as
// a search of everything has it.

#include "shoal/solvers/registration/descent.hpp"

#include <stdexcept>

#include "shoal/core/angles.hpp"
#include "tests/solvers/registration_support.hpp"

namespace shoal::solvers {
namespace {

using namespace tests;
using Eigen::Vector2d;

TEST(RegistrationByDescent, AgreesWithTheClosedFormForTheSquareOnAnyPairs) {
  const auto closed = solver("procrustes");
  for (const std::string& name : descents()) {
    const auto descent = solver(name, 1e-8);
    EXPECT_TRUE(rc::check(name, [&] {
      const Pairs pairs = drawn_pairs();
      const RegistrationSolution expected = closed->solve({pairs});
      RC_PRE(expected.status == Status::converged);
      const RegistrationSolution found = descent->solve({pairs});
      RC_ASSERT(found.status == Status::converged);
      RC_ASSERT(apart(found.T_to_from, expected.T_to_from, pairs) < 1e-6);
      RC_ASSERT(std::abs(found.cost - expected.cost) < 1e-9 * expected.cost);
    }));
  }
}

// Huber with a scale beyond all residuals is the square, but begins from two pairs, too.
TEST(RegistrationByDescent, AgreesWithTheClosedFormForALossThatIsTheSquareWherePairsAre) {
  const auto closed = solver("procrustes");
  const auto huber = loss("huber", 1e5);
  for (const std::string& name : descents()) {
    const auto descent = solver(name, 1e-8);
    EXPECT_TRUE(rc::check(name, [&] {
      const Pairs pairs = drawn_formation(drawn_count(3, 12), 1);
      const RegistrationSolution expected = closed->solve({pairs});
      const RegistrationSolution found = descent->solve({pairs, huber.get()});
      RC_ASSERT(found.status == Status::converged);
      RC_ASSERT(apart(found.T_to_from, expected.T_to_from, pairs) < 1e-6);
    }));
  }
}

/// The lowest cost of all, by a fine search over the angle and, for each, reweighted means
/// (Weiszfeld) from the shift that each pair alone asks for.
double least_cost(const Pairs& pairs, const Loss& of) {
  const auto at_angle = [&](double angle) {
    Transform2 motion = Transform2::from_angle(angle, {0, 0});
    double least = std::numeric_limits<double>::infinity();
    for (const PointPair& start : pairs) {
      motion.translation = start.to - motion.rotate(start.from);
      double cost = cost_of(motion, pairs, of);
      for (int round = 0; round < 200; ++round) {
        Vector2d sum(0, 0);
        double weights = 0.0;
        for (const PointPair& p : pairs) {
          const double pull = p.weight * of.at((motion * p.from - p.to).squaredNorm()).slope;
          sum += pull * (p.to - motion.rotate(p.from));
          weights += pull;
        }
        if (!(weights > 0.0)) break;
        motion.translation = sum / weights;
        const double now = cost_of(motion, pairs, of);
        const bool settled = cost - now < 1e-13 * cost;
        cost = now;
        if (settled) break;
      }
      least = std::min(least, cost);
    }
    return least;
  };
  double best = 0.0, least = std::numeric_limits<double>::infinity(), step = radians(1.0);
  for (double angle = -pi; angle < pi; angle += step) {
    const double cost = at_angle(angle);
    if (cost < least) {
      least = cost;
      best = angle;
    }
  }
  while (step > 1e-8) {  // halve the distance to both neighbours
    step *= 0.5;
    const double before = at_angle(best - step), behind = at_angle(best + step);
    if (std::min(before, behind) < least) {
      best += before < behind ? -step : step;
      least = std::min(before, behind);
    }
  }
  return least;
}

TEST(RegistrationByDescent, FindsTheLowestCostOfAllAmongOutliers) {
  for (const auto& [name, scale_m] :
       {std::pair{"huber", 20.0}, {"cauchy", 20.0}, {"tukey", 60.0}}) {
    const auto of = loss(name, scale_m);
    EXPECT_TRUE(rc::check(name, [&, &kind = name] {
      const Pairs pairs = drawn_formation(drawn_count(5, 7), drawn_count(0, 2));
      const double least = least_cost(pairs, *of);
      for (const std::string& with : descents()) {
        const RegistrationSolution found = solver(with)->solve({pairs, of.get()});
        RC_LOG() << kind << " by " << with << ": " << name_of(found.status) << ", " << found.cost
                 << ", oracle " << least << '\n';
        RC_ASSERT(found.usable());
        RC_ASSERT(std::abs(found.cost - least) < 1e-5 * (1.0 + least));
      }
    }));
  }
}

TEST(RegistrationByDescent, IsNotBeatenByANeighbouringMotionOnAnyPairs) {
  for (const std::string& name : Registry<Loss>::instance().names()) {
    const auto of = loss(name);
    for (const std::string& with : descents()) {
      EXPECT_TRUE(rc::check(name + " by " + with, [&] {
        const Pairs pairs = drawn_pairs();
        const RegistrationSolution solution = solver(with)->solve({pairs, of.get()});
        RC_ASSERT(solution.usable());
        RC_PRE(solution.status == Status::converged);
        const Transform2& best = solution.T_to_from;
        for (const double turn : {-1e-3, 0.0, 1e-3}) {
          for (const Vector2d& shift : {Vector2d(0, 0), Vector2d(0.5, 0), Vector2d(0, -0.5)}) {
            const Transform2 beside = Transform2::from_angle(turn, shift) * best;
            RC_ASSERT(cost_of(beside, pairs, *of) >= solution.cost * (1.0 - 1e-9));
          }
        }
      }));
    }
  }
}

TEST(RegistrationByDescent, LetsOnePairOfFiveHundredMetresPullOnlyWithTheSquare) {
  const Pairs clean = lattice(), spoilt = lattice(500.0);
  const auto pulled = [&](const std::string& with, const char* name, double scale_m = 0.0) {
    const auto of = loss(name, scale_m);
    const auto fit = [&](const Pairs& pairs) {
      return solver(with)->solve({pairs, of.get()}).T_to_from;
    };
    Pairs others = clean;
    others.erase(others.begin() + 6);
    return apart(fit(spoilt), of->at(1e10).slope > 0.0 ? fit(clean) : fit(others), others);
  };
  EXPECT_GT(pulled("procrustes", "least_squares"), 40.0);
  for (const std::string& with : descents()) {
    EXPECT_GT(pulled(with, "least_squares"), 40.0) << with;
    EXPECT_LT(pulled(with, "huber", 10.0), 5.0) << with;
    EXPECT_LT(pulled(with, "cauchy", 10.0), 1.0) << with;
    EXPECT_LT(pulled(with, "tukey", 50.0), 1e-3) << with;  // as if the pair were not there
  }
}

// From the motion of least squares alone Tukey's loss is flat here: all residuals exceed its scale.
TEST(RegistrationByDescent, IsNotTrappedByTheAnswerOfLeastSquares) {
  Pairs pairs = lattice();
  for (const int i : {1, 4, 8, 9}) {
    pairs[static_cast<std::size_t>(i)].to += Vector2d(2000.0, -1500.0 * i);
  }
  const auto tukey = loss("tukey", 30.0);
  const Transform2 of_squares = solver("procrustes")->solve({pairs}).T_to_from;
  for (const PointPair& p : pairs) ASSERT_GT((of_squares * p.from - p.to).norm(), 30.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with)->solve({pairs, tukey.get()});
    EXPECT_TRUE(is(solution, Status::converged)) << with;
    EXPECT_LT(apart(solution.T_to_from, Transform2::from_angle(0.7, {40, -70}), pairs), 8.0)
        << with;
  }
}

TEST(RegistrationByDescent, LeavesTheRotationOpenWhereOnlyOnePairIsWithinTheReachOfTheLoss) {
  // No motion brings two of these within 1 m of their places.
  const Pairs pairs{{{0, 0}, {7, 7}}, {{100, 0}, {307, 7}}, {{0, 100}, {7, 507}}};
  const auto tukey = loss("tukey", 1.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with)->solve({pairs, tukey.get()});
    EXPECT_TRUE(is(solution, Status::undetermined)) << with;
    EXPECT_NEAR(solution.cost, 2.0 / 3.0, 1e-12) << with;
  }
}

TEST(RegistrationByDescent, AnswersMirroredSquaresWhoseRotationIsOpenAsTheClosedFormDoes) {
  const Pairs mirrored{
      {{1, 1}, {-1, 1}}, {{-1, 1}, {1, 1}}, {{-1, -1}, {1, -1}}, {{1, -1}, {-1, -1}}};
  for (const std::string& name : Registry<RegistrationSolver>::instance().names()) {
    EXPECT_TRUE(is(solver(name)->solve({mirrored}), Status::undetermined)) << name;
  }
}

TEST(RegistrationByDescent, TakesManyPairs) {
  Pairs pairs;
  const auto motion = Transform2::from_angle(-2.0, {10, 20});
  for (int i = 0; i < 500; ++i) {
    const Vector2d slot(300.0 * (i % 25), 300.0 * (i / 25));
    const bool outlier = i % 5 == 3;
    pairs.push_back({slot, outlier ? Vector2d(7.0 * i, -900.0) : motion * slot});
  }
  const auto tukey = loss("tukey");
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with)->solve({pairs, tukey.get()});
    EXPECT_TRUE(is(solution, Status::converged)) << with;
    EXPECT_LT(apart(solution.T_to_from, motion, pairs), 1e-3) << with;
  }
}

TEST(RegistrationByDescent, SaysWhenItsEvaluationsRanOut) {
  const Pairs pairs = lattice(500.0);
  const auto huber = loss("huber", 5.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with, 1e-9, 1)->solve({pairs, huber.get()});
    EXPECT_TRUE(is(solution, Status::budget)) << with;
    EXPECT_TRUE(solution.usable());
    EXPECT_EQ(solution.evaluations, 2) << with;  // one a start
    EXPECT_LE(solution.cost, cost_of(solver("procrustes")->solve({pairs}).T_to_from, pairs, *huber))
        << with;
  }
}

struct LossError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Throwing final : Loss {
  LossValue at(double) const override { throw LossError("no loss today"); }
};

struct NotANumber final : Loss {
  LossValue at(double) const override { return {nan_value, nan_value, nan_value}; }
};

TEST(RegistrationByDescent, LetsTheExceptionOfTheLossThroughAndSaysWhereNoCostIsFinite) {
  const Pairs pairs = lattice();
  const Throwing throwing;
  const NotANumber not_a_number;
  for (const std::string& with : descents()) {
    try {
      solver(with)->solve({pairs, &throwing});
      ADD_FAILURE() << with << " swallowed the exception";
    } catch (const LossError& error) {
      EXPECT_STREQ(error.what(), "no loss today") << with;
    }
    const RegistrationSolution solution = solver(with)->solve({pairs, &not_a_number});
    EXPECT_TRUE(is(solution, Status::diverged)) << with;
    EXPECT_TRUE(std::isnan(solution.T_to_from.sine)) << with;
  }
}

}  // namespace
}  // namespace shoal::solvers
