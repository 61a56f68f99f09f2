// What holds for every enrolled solver of the family with every loss, and for each kind of loss.

#include "shoal/solvers/registration/registration.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <vector>

#include "shoal/core/angles.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using Pairs = std::vector<PointPair>;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

std::unique_ptr<Loss> loss(const std::string& name, double scale_m = 0.0) {
  Setting table;
  if (scale_m > 0.0) table.at_or_new("scale_m").value = scale_m;
  return Registry<Loss>::instance().make(name, table, "loss." + name);
}

std::unique_ptr<RegistrationSolver> solver(const std::string& name, double x_tolerance_m = 0.0,
                                           std::int64_t max_evaluations = 0) {
  Setting table;
  if (x_tolerance_m > 0.0) table.at_or_new("x_tolerance_m").value = x_tolerance_m;
  if (max_evaluations > 0) table.at_or_new("max_evaluations").value = max_evaluations;
  return Registry<RegistrationSolver>::instance().make(name, table, "registration." + name);
}

std::vector<std::string> descents() {
  auto names = Registry<RegistrationSolver>::instance().names();
  std::erase(names, "procrustes");
  return names;
}

double cost_of(const Transform2& motion, const Pairs& pairs, const Loss& of) {
  double cost = 0.0;
  for (const PointPair& p : pairs) {
    cost += p.weight * of.at((motion * p.from - p.to).squaredNorm()).value;
  }
  return cost;
}

/// How far apart two motions carry the `from` points, at most, m.
double apart(const Transform2& a, const Transform2& b, const Pairs& pairs) {
  double most = 0.0;
  for (const PointPair& p : pairs) most = std::max(most, (a * p.from - b * p.from).norm());
  return most;
}

::testing::AssertionResult is(const RegistrationSolution& solution, RegistrationStatus expected) {
  if (solution.status == expected) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << name_of(solution.status) << " after " << solution.evaluations;
}

// Draws, inside rc::check() only.

double drawn(double low, double high) {
  return low + (high - low) * (*rc::gen::resize(100, rc::gen::inRange(0, 1'000'001))) * 1e-6;
}

Vector2d drawn_point(double reach_m) {
  return {drawn(-reach_m, reach_m), drawn(-reach_m, reach_m)};
}

Transform2 drawn_motion(double reach_m = 1000.0) {
  return Transform2::from_angle(drawn(-pi, pi), drawn_point(reach_m));
}

int drawn_count(int least, int most) {
  return *rc::gen::resize(100, rc::gen::inRange(least, most + 1));
}

Pairs drawn_pairs() {
  Pairs pairs(static_cast<std::size_t>(drawn_count(3, 20)));
  for (PointPair& p : pairs) p = {drawn_point(1000), drawn_point(1000), drawn(0.1, 3.0)};
  return pairs;
}

/// A rigid motion of points in a formation, with noise of metres, and some pairs far off.
Pairs drawn_formation(int count, int outliers) {
  const Transform2 motion = drawn_motion();
  Pairs pairs(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].from = drawn_point(600);
    for (std::size_t k = 0; k < i; ++k) RC_PRE((pairs[i].from - pairs[k].from).norm() > 100.0);
    const bool outlier = i < static_cast<std::size_t>(outliers);
    pairs[i].to =
        motion * pairs[i].from + (outlier ? Vector2d(Transform2::from_angle(drawn(-pi, pi), {0, 0})
                                                         .rotate({drawn(300.0, 600.0), 0.0}))
                                          : drawn_point(5.0));
    pairs[i].weight = drawn(0.5, 1.5);
  }
  return pairs;
}

/// A lattice turned by 0.7 rad, with fixed noise of metres and, if wanted, a pair 500 m off.
Pairs lattice(double outlier_m = 0.0, const Vector2d& away = {40, -70}) {
  const auto motion = Transform2::from_angle(0.7, away);
  Pairs pairs;
  for (int i = 0; i < 10; ++i) {
    const Vector2d slot(300.0 * (i % 4), 300.0 * (i / 4));
    const Vector2d noise(3.0 * std::sin(7.0 * i), 3.0 * std::cos(11.0 * i));
    pairs.push_back({slot, motion * slot + noise, i == 0 ? 0.1 : 1.0});
  }
  pairs[6].to += Vector2d(0.0, outlier_m);
  return pairs;
}

using Combination = std::tuple<std::string, std::string>;  // solver, loss

std::vector<Combination> combinations(bool only_taken) {
  std::vector<Combination> all;
  for (const std::string& with : Registry<RegistrationSolver>::instance().names()) {
    for (const std::string& of : Registry<Loss>::instance().names()) {
      const auto posed = loss(of);
      if (!only_taken || !solver(with)->refuses({{}, posed.get()})) all.emplace_back(with, of);
    }
  }
  return all;
}

class EveryCombination : public testing::TestWithParam<Combination> {
 protected:
  const std::unique_ptr<Loss> of = loss(std::get<1>(GetParam()));
  const std::unique_ptr<RegistrationSolver> with = solver(std::get<0>(GetParam()));

  RegistrationSolution fit(const Pairs& pairs) const { return with->solve({pairs, of.get()}); }
};
class EnrolledRegistration : public EveryCombination {};

TEST_P(EveryCombination, IsSolvedOrExplained) {
  const Pairs pairs = lattice();
  const RegistrationSolution solution = fit(pairs);
  if (!with->refuses({{}, of.get()})) {
    EXPECT_TRUE(is(solution, RegistrationStatus::fitted));
    EXPECT_NEAR(solution.T_to_from.angle(), 0.7, 0.01);
    EXPECT_NEAR(solution.cost, cost_of(solution.T_to_from, pairs, *of), 1e-9 * solution.cost);
    return;
  }
  EXPECT_TRUE(is(solution, RegistrationStatus::bad_input));
  EXPECT_TRUE(std::isnan(solution.cost));
  EXPECT_TRUE(std::isnan(solution.T_to_from.cosine));
  EXPECT_TRUE(solution.T_to_from.translation.array().isNaN().all());
  const std::string why = *with->refuses({pairs, of.get()});
  for (const std::string& other : Registry<RegistrationSolver>::instance().names()) {
    const bool named = why.find(other) != std::string::npos;
    EXPECT_EQ(named, !solver(other)->refuses({pairs, of.get()})) << other << ": " << why;
  }
}

TEST_P(EnrolledRegistration, IsTheIdentityForIdenticalPoints) {
  const RegistrationSolution solution =
      fit({{{3, 4}, {3, 4}}, {{-5, 1}, {-5, 1}}, {{7, -2}, {7, -2}}});
  EXPECT_TRUE(is(solution, RegistrationStatus::fitted));
  EXPECT_NEAR(solution.T_to_from.angle(), 0.0, 1e-12);
  EXPECT_NEAR(solution.T_to_from.translation.norm(), 0.0, 1e-12);
}

TEST_P(EnrolledRegistration, AnswersDegenerateSetsWithAStatus) {
  const auto only_moved = [&](const Pairs& pairs) {
    const RegistrationSolution solution = fit(pairs);
    EXPECT_TRUE(is(solution, RegistrationStatus::translation_only));
    EXPECT_EQ(solution.T_to_from.cosine, 1.0);
    EXPECT_EQ(solution.T_to_from.sine, 0.0);
    EXPECT_NEAR(solution.cost, cost_of(solution.T_to_from, pairs, *of), 1e-9);
    for (const Vector2d& step : {Vector2d(0.1, 0), Vector2d(0, 0.1), Vector2d(-0.1, -0.1)}) {
      Transform2 beside = solution.T_to_from;
      beside.translation += step;
      EXPECT_GE(cost_of(beside, pairs, *of), solution.cost);
    }
  };
  only_moved({{{1, 2}, {5, 7}}});                                                    // one pair
  only_moved({{{1, 2}, {5, 7}}, {{3, 4}, {9, 9}, 0.0}});                             // that counts
  only_moved({{{1, 2}, {5, 7}}, {{1, 2}, {9, 9}}});                                  // coincident
  only_moved({{{1, 2}, {5, 7}}, {{3, 3}, {5, 7}}});                                  // the others
  only_moved({{{.1, .7}, {5, 7}}, {{.1, .7}, {.3, .9}}, {{.1, .7}, {1e3, 3}}});      // spread `to`
  only_moved({{{1e6, 7}, {5, 1e6}}, {{1e6, 7}, {8, 1e6}}, {{1e6, 7}, {300, 1e6}}});  // far away

  const RegistrationSolution line = fit({{{0, 0}, {1, 1}}, {{2, 0}, {1, 3}}, {{5, 0}, {1, 6}}});
  EXPECT_TRUE(is(line, RegistrationStatus::fitted)) << "collinear";
  EXPECT_NEAR(line.T_to_from.angle(), radians(90.0), 1e-9);
}

TEST_P(EnrolledRegistration, RefusesWhatItCannotWeighOrRead) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Pairs& wrong : {
           Pairs{},
           Pairs{{{0, 0}, {1, 1}, 0.0}},
           Pairs{{{0, 0}, {1, 1}, -1.0}, {{1, 0}, {2, 1}}, {{5, 0}, {2, 1}}},
           Pairs{{{0, nan_value}, {1, 1}}, {{1, 0}, {2, 1}}},
           Pairs{{{0, 0}, {infinity, 1}}, {{1, 0}, {2, 1}}},
           Pairs{{{0, 0}, {1, 1}, nan_value}, {{1, 0}, {2, 1}}},
           Pairs{{{0, 0}, {1, 1}, infinity}, {{1, 0}, {2, 1}}},
           Pairs{{{0, 0}, {0, 0}}, {{1e200, 0}, {1e200, 0}}},
       }) {
    const RegistrationSolution solution = fit(wrong);
    EXPECT_TRUE(is(solution, RegistrationStatus::bad_input)) << wrong.size() << " pairs";
    EXPECT_TRUE(std::isnan(solution.T_to_from.translation.x()));
  }
}

TEST_P(EnrolledRegistration, MovesWithItsPointsAndIgnoresTheirOrderAndTheScaleOfTheWeights) {
  EXPECT_TRUE(rc::check("is equivariant", [&] {
    const Pairs pairs = drawn_formation(drawn_count(4, 8), 1);
    const RegistrationSolution before = fit(pairs);
    RC_ASSERT(before.usable());

    const Transform2 motion = drawn_motion();
    Transform2 to, from;
    Pairs other = pairs;
    double scale = 1.0;
    switch (drawn_count(0, 3)) {
      case 0:
        to = motion;
        for (PointPair& p : other) p.to = motion * p.to;
        break;
      case 1:
        from = motion;
        for (PointPair& p : other) p.from = motion * p.from;
        break;
      case 2:
        std::ranges::rotate(other, other.begin() + 2);
        std::swap(other[0], other[1]);
        break;
      default:
        scale = std::pow(10.0, drawn_count(-9, 9));
        for (PointPair& p : other) p.weight *= scale;
    }
    const RegistrationSolution after = fit(other);
    RC_ASSERT(apart(to.inverse() * after.T_to_from * from, before.T_to_from, pairs) < 1e-3);
    RC_ASSERT(std::abs(after.cost - scale * before.cost) < 1e-6 * scale * before.cost);
  }));
}

TEST_P(EnrolledRegistration, NeverAnswersWithAReflection) {
  EXPECT_TRUE(rc::check("cosine^2 + sine^2 = 1 for mirrored sets, and the cost is its own", [&] {
    Pairs pairs = drawn_pairs();
    for (PointPair& p : pairs) p.to = {-p.from.x(), p.from.y()};
    const RegistrationSolution solution = fit(pairs);
    RC_ASSERT(solution.usable());
    const Transform2& t = solution.T_to_from;
    RC_ASSERT(std::abs(t.cosine * t.cosine + t.sine * t.sine - 1.0) < 1e-14);
    RC_ASSERT(std::abs(solution.cost - cost_of(t, pairs, *of)) < 1e-8 * (1.0 + solution.cost));
  }));
}

TEST_P(EnrolledRegistration, KeepsItsDigitsFarFromTheOrigin) {
  const Vector2d away(1e6, -1e6);
  const Pairs near = lattice();
  const Pairs far = lattice(0.0, Vector2d(40, -70) + away);
  const Transform2 here = fit(near).T_to_from;
  Transform2 there = fit(far).T_to_from;
  there.translation -= away;
  EXPECT_LT(apart(here, there, near), 1e-6);
}

TEST_P(EnrolledRegistration, FindsAnyAngle) {
  for (int deg = -360; deg <= 360; deg += 15) {
    const auto motion = Transform2::from_angle(radians(deg), {5, 6});
    Pairs pairs = lattice();
    for (PointPair& p : pairs) p.to = motion * p.from;
    pairs[3].to += Vector2d(2, 1);
    const RegistrationSolution solution = fit(pairs);
    EXPECT_TRUE(is(solution, RegistrationStatus::fitted)) << deg;
    EXPECT_NEAR(wrapped(solution.T_to_from.angle() - motion.angle()), 0.0, 5e-3) << deg;
  }
}

TEST_P(EnrolledRegistration, GivesTwoThreadsTheSameBits) {
  std::vector<Transform2> here, there;
  const auto fly = [&](std::vector<Transform2>& motions) {
    for (int k = 0; k < 20; ++k) motions.push_back(fit(lattice(25.0 * k)).T_to_from);
  };
  {
    std::jthread other(fly, std::ref(there));
    fly(here);
  }
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_EQ(here[k].cosine, there[k].cosine);
    EXPECT_EQ(here[k].translation, there[k].translation);
  }
}

const auto name_of_combination = [](const auto& tested) {
  return std::get<0>(tested.param) + "_" + std::get<1>(tested.param);
};
INSTANTIATE_TEST_SUITE_P(Registration, EveryCombination, testing::ValuesIn(combinations(false)),
                         name_of_combination);
INSTANTIATE_TEST_SUITE_P(Registration, EnrolledRegistration, testing::ValuesIn(combinations(true)),
                         name_of_combination);

TEST(Registration, HasTheSolversPromised) {
  for (const char* name : {"procrustes", "ceres", "newton"}) EXPECT_NO_THROW(solver(name)) << name;
}

TEST(Registration, TakesTheOptionsOfTheSmoothSolver) {
  EXPECT_NO_THROW(solver("newton", 1e-6, 50));
  Setting wrong;
  wrong.at_or_new("x_tolerance").value = 1.0;
  EXPECT_THROW(Registry<RegistrationSolver>::instance().make("newton", wrong, "r"), InputError);
  EXPECT_THROW(solver("procrustes", 1e-6), InputError);
}

TEST(Registration, SplitsAStretchedPairInTheMiddleWithEverySolver) {
  // Two points 2 m apart onto two 4 m apart: each end is 1 m off. A quarter turn, too.
  const Pairs pairs{{{-1, 0}, {3, 2}}, {{1, 0}, {3, 6}}};
  for (const std::string& name : Registry<RegistrationSolver>::instance().names()) {
    const RegistrationSolution solution = solver(name)->solve({pairs});
    EXPECT_TRUE(is(solution, RegistrationStatus::fitted)) << name;
    EXPECT_NEAR(solution.cost, 2.0, 1e-12) << name;
    EXPECT_NEAR(solution.T_to_from.angle(), radians(90.0), 1e-9) << name;
    EXPECT_LT((solution.T_to_from.translation - Vector2d(3, 4)).norm(), 1e-9) << name;
    EXPECT_EQ(solution.evaluations > 0, name != "procrustes") << name;
  }
}

TEST(Registration, AgreesWithTheClosedFormForTheSquareOnAnyPairs) {
  const auto closed = solver("procrustes");
  for (const std::string& name : descents()) {
    const auto descent = solver(name, 1e-8);
    EXPECT_TRUE(rc::check(name, [&] {
      const Pairs pairs = drawn_pairs();
      const RegistrationSolution expected = closed->solve({pairs});
      RC_PRE(expected.status == RegistrationStatus::fitted);
      const RegistrationSolution found = descent->solve({pairs});
      RC_ASSERT(found.status == RegistrationStatus::fitted);
      RC_ASSERT(apart(found.T_to_from, expected.T_to_from, pairs) < 1e-6);
      RC_ASSERT(std::abs(found.cost - expected.cost) < 1e-9 * expected.cost);
    }));
  }
}

// Huber with a scale beyond all residuals is the square, but begins from two pairs, too.
TEST(Registration, AgreesWithTheClosedFormForALossThatIsTheSquareWherePairsAre) {
  const auto closed = solver("procrustes");
  const auto huber = loss("huber", 1e5);
  for (const std::string& name : descents()) {
    const auto descent = solver(name, 1e-8);
    EXPECT_TRUE(rc::check(name, [&] {
      const Pairs pairs = drawn_formation(drawn_count(3, 12), 1);
      const RegistrationSolution expected = closed->solve({pairs});
      const RegistrationSolution found = descent->solve({pairs, huber.get()});
      RC_ASSERT(found.status == RegistrationStatus::fitted);
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

TEST(Registration, FindsTheLowestCostOfAllAmongOutliers) {
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

TEST(Registration, IsNotBeatenByANeighbouringMotionOnAnyPairs) {
  for (const std::string& name : Registry<Loss>::instance().names()) {
    const auto of = loss(name);
    for (const std::string& with : descents()) {
      EXPECT_TRUE(rc::check(name + " by " + with, [&] {
        const Pairs pairs = drawn_pairs();
        const RegistrationSolution solution = solver(with)->solve({pairs, of.get()});
        RC_ASSERT(solution.usable());
        RC_PRE(solution.status == RegistrationStatus::fitted);
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

TEST(Registration, LetsOnePairOfFiveHundredMetresPullOnlyWithTheSquare) {
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
TEST(Registration, IsNotTrappedByTheAnswerOfLeastSquares) {
  Pairs pairs = lattice();
  for (const int i : {1, 4, 8, 9}) {
    pairs[static_cast<std::size_t>(i)].to += Vector2d(2000.0, -1500.0 * i);
  }
  const auto tukey = loss("tukey", 30.0);
  const Transform2 of_squares = solver("procrustes")->solve({pairs}).T_to_from;
  for (const PointPair& p : pairs) ASSERT_GT((of_squares * p.from - p.to).norm(), 30.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with)->solve({pairs, tukey.get()});
    EXPECT_TRUE(is(solution, RegistrationStatus::fitted)) << with;
    EXPECT_LT(apart(solution.T_to_from, Transform2::from_angle(0.7, {40, -70}), pairs), 8.0)
        << with;
  }
}

TEST(Registration, LeavesTheRotationOpenWhereOnlyOnePairIsWithinTheReachOfTheLoss) {
  // No motion brings two of these within 1 m of their places.
  const Pairs pairs{{{0, 0}, {7, 7}}, {{100, 0}, {307, 7}}, {{0, 100}, {7, 507}}};
  const auto tukey = loss("tukey", 1.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with)->solve({pairs, tukey.get()});
    EXPECT_TRUE(is(solution, RegistrationStatus::translation_only)) << with;
    EXPECT_NEAR(solution.cost, 2.0 / 3.0, 1e-12) << with;
  }
}

TEST(Registration, AnswersMirroredSquaresWhoseRotationIsOpenAsTheClosedFormDoes) {
  const Pairs mirrored{
      {{1, 1}, {-1, 1}}, {{-1, 1}, {1, 1}}, {{-1, -1}, {1, -1}}, {{1, -1}, {-1, -1}}};
  for (const std::string& name : Registry<RegistrationSolver>::instance().names()) {
    EXPECT_TRUE(is(solver(name)->solve({mirrored}), RegistrationStatus::translation_only)) << name;
  }
}

TEST(Registration, TakesManyPairs) {
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
    EXPECT_TRUE(is(solution, RegistrationStatus::fitted)) << with;
    EXPECT_LT(apart(solution.T_to_from, motion, pairs), 1e-3) << with;
  }
}

TEST(Registration, SaysWhenItsEvaluationsRanOut) {
  const Pairs pairs = lattice(500.0);
  const auto huber = loss("huber", 5.0);
  for (const std::string& with : descents()) {
    const RegistrationSolution solution = solver(with, 1e-9, 1)->solve({pairs, huber.get()});
    EXPECT_TRUE(is(solution, RegistrationStatus::not_converged)) << with;
    EXPECT_TRUE(solution.usable());
    EXPECT_EQ(solution.evaluations, 2) << with;  // one a start
    EXPECT_LE(solution.cost, cost_of(solver("procrustes")->solve({pairs}).T_to_from, pairs, *huber))
        << with;
  }
}

struct MyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Throwing final : Loss {
  LossValue at(double) const override { throw MyError("no loss today"); }
};

struct NotANumber final : Loss {
  LossValue at(double) const override { return {nan_value, nan_value, nan_value}; }
};

TEST(Registration, LetsTheExceptionOfTheLossThroughAndSaysWhereNoCostIsFinite) {
  const Pairs pairs = lattice();
  const Throwing throwing;
  const NotANumber not_a_number;
  for (const std::string& with : descents()) {
    try {
      solver(with)->solve({pairs, &throwing});
      ADD_FAILURE() << with << " swallowed the exception";
    } catch (const MyError& error) {
      EXPECT_STREQ(error.what(), "no loss today") << with;
    }
    const RegistrationSolution solution = solver(with)->solve({pairs, &not_a_number});
    EXPECT_TRUE(is(solution, RegistrationStatus::diverged)) << with;
    EXPECT_TRUE(std::isnan(solution.T_to_from.sine)) << with;
  }
}

}  // namespace
}  // namespace shoal::solvers
