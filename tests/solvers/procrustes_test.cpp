#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <vector>

#include "shoal/core/angles.hpp"
#include "shoal/solvers/matching/points.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

struct Pair {
  Vector2d from, to;
  double weight = 1.0;
};

RegistrationSolution fit(const std::vector<Pair>& pairs) {
  Procrustes sums;
  for (const Pair& p : pairs) sums.add(p.from, p.to, p.weight);
  return sums.solve();
}

double sum_of_squares(const Transform2& motion, const std::vector<Pair>& pairs) {
  double cost = 0.0;
  for (const Pair& p : pairs) cost += p.weight * (motion * p.from - p.to).squaredNorm();
  return cost;
}

double any_in(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 1'000'001)) * 1e-6;
}

Vector2d any_point() {
  return {any_in(-1000.0, 1000.0), any_in(-1000.0, 1000.0)};
}

Transform2 any_motion() {
  return Transform2::from_angle(any_in(-3.14, 3.14), any_point());
}

std::vector<Pair> any_pairs() {
  std::vector<Pair> pairs(static_cast<std::size_t>(*rc::gen::inRange(3, 20)));
  for (Pair& p : pairs) p = {any_point(), any_point(), any_in(0.1, 3.0)};
  return pairs;
}

TEST(Procrustes, TurnsAUnitSquareByAQuarterAndShiftsIt) {
  // (x, y) -> (-y, x) + (10, 20)
  const auto solution = fit({{{0, 0}, {10, 20}}, {{1, 0}, {10, 21}}, {{1, 1}, {9, 21}}});
  ASSERT_EQ(solution.status, Status::converged);
  EXPECT_NEAR(solution.T_to_from.angle(), radians(90.0), 1e-14);
  EXPECT_NEAR((solution.T_to_from.translation - Vector2d(10, 20)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(solution.cost, 0.0, 1e-13);
}

TEST(Procrustes, SplitsAStretchedPairInTheMiddle) {
  // Two points 2 m apart onto two 4 m apart: each end is 1 m off.
  const auto solution = fit({{{-1, 0}, {-2, 0}}, {{1, 0}, {2, 0}}});
  ASSERT_EQ(solution.status, Status::converged);
  EXPECT_NEAR(solution.cost, 2.0, 1e-13);
}

TEST(Procrustes, IsTheIdentityForIdenticalPoints) {
  const auto solution = fit({{{3, 4}, {3, 4}}, {{-5, 1}, {-5, 1}}, {{7, -2}, {7, -2}}});
  EXPECT_NEAR(solution.T_to_from.angle(), 0.0, 1e-15);
  EXPECT_NEAR(solution.T_to_from.translation.norm(), 0.0, 1e-14);
}

TEST(Procrustes, FindsAnyRigidMotionExactlyWhateverTheWeights) {
  EXPECT_TRUE(rc::check("recovers the motion", [] {
    const Transform2 motion = any_motion();
    auto pairs = any_pairs();
    for (Pair& p : pairs) p.to = motion * p.from;
    RC_PRE((pairs[0].from - pairs[1].from).norm() > 1.0);
    const auto solution = fit(pairs);
    RC_ASSERT(solution.status == Status::converged);
    RC_ASSERT(std::abs(wrapped(solution.T_to_from.angle() - motion.angle())) < 1e-11);
    for (const Pair& p : pairs) RC_ASSERT((solution.T_to_from * p.from - p.to).norm() < 1e-8);
  }));
}

TEST(Procrustes, IsNotBeatenByANeighbouringMotionAndReportsItsOwnCost) {
  EXPECT_TRUE(rc::check("is a minimum", [] {
    const auto pairs = any_pairs();
    const auto solution = fit(pairs);
    RC_PRE(solution.status == Status::converged);
    const double cost = sum_of_squares(solution.T_to_from, pairs);
    RC_ASSERT(std::abs(cost - solution.cost) < 1e-11 * (1.0 + cost) * 100.0);
    const Transform2& best = solution.T_to_from;
    for (const double turn : {-0.01, 0.0, 0.01}) {
      for (const Vector2d& shift : {Vector2d(0, 0), Vector2d(0.5, 0), Vector2d(0, -0.5)}) {
        const auto other = Transform2::from_angle(best.angle() + turn, best.translation + shift);
        RC_ASSERT(sum_of_squares(other, pairs) >= cost - 1e-9 * (1.0 + cost));
      }
    }
  }));
}

TEST(Procrustes, MovesWithItsTargets) {
  EXPECT_TRUE(rc::check("is equivariant", [] {
    const auto pairs = any_pairs();
    const Transform2 moved = any_motion();
    auto later = pairs;
    for (Pair& p : later) p.to = moved * p.to;
    const auto before = fit(pairs);
    const auto after = fit(later);
    for (const Pair& p : pairs) {
      const Vector2d expected = moved * (before.T_to_from * p.from);
      RC_ASSERT((after.T_to_from * p.from - expected).norm() < 1e-5);
    }
  }));
}

TEST(Procrustes, CountsAPairOfWeightTwoLikeThePairTwice) {
  EXPECT_TRUE(rc::check("weights are multiplicities", [] {
    auto once = any_pairs();
    for (Pair& p : once) p.weight = 1.0;
    auto twice = once;
    twice.push_back(once[0]);
    once[0].weight = 2.0;
    const auto a = fit(once);
    const auto b = fit(twice);
    RC_ASSERT(std::abs(a.cost - b.cost) < 1e-9 * (1.0 + a.cost));
  }));
}

TEST(Procrustes, NeverAnswersWithAReflection) {
  EXPECT_TRUE(rc::check("cosine^2 + sine^2 = 1 for mirrored sets", [] {
    auto pairs = any_pairs();
    for (Pair& p : pairs) p.to = {-p.from.x(), p.from.y()};
    const auto solution = fit(pairs);
    const Transform2& t = solution.T_to_from;
    RC_ASSERT(std::abs(t.cosine * t.cosine + t.sine * t.sine - 1.0) < 1e-14);
    RC_ASSERT(std::abs(solution.cost - sum_of_squares(t, pairs)) < 1e-8 * (1.0 + solution.cost));
  }));
}

TEST(Procrustes, KeepsItsDigitsFarFromTheOrigin) {
  const Vector2d away(4.0e6, -7.0e6);
  const auto motion = Transform2::from_angle(0.3, {0, 0});
  std::vector<Pair> pairs;
  for (const Vector2d& p : {Vector2d(0, 0), Vector2d(300, 0), Vector2d(0, 300)}) {
    pairs.push_back({p, motion * p + away});
  }
  EXPECT_NEAR(fit(pairs).T_to_from.angle(), 0.3, 1e-11);
}

TEST(Procrustes, OnlyTranslatesWhenThePointsDoNotFixTheRotation) {
  const auto identity_rotation = [](const RegistrationSolution& solution) {
    return solution.status == Status::undetermined && solution.T_to_from.cosine == 1.0 &&
           solution.T_to_from.sine == 0.0;
  };
  EXPECT_TRUE(identity_rotation(fit({{{1, 2}, {5, 7}}}))) << "one pair";
  EXPECT_NEAR((fit({{{1, 2}, {5, 7}}}).T_to_from.translation - Vector2d(4, 5)).norm(), 0, 1e-15);
  EXPECT_TRUE(identity_rotation(fit({{{1, 2}, {5, 7}}, {{1, 2}, {9, 9}}}))) << "coincident from";
  EXPECT_TRUE(identity_rotation(fit({{{1, 2}, {5, 7}}, {{3, 3}, {5, 7}}}))) << "coincident to";
  EXPECT_TRUE(identity_rotation(
      fit({{{0.1, 0.7}, {5, 7}}, {{0.1, 0.7}, {0.3, 0.9}}, {{0.1, 0.7}, {1e3, 3}}})))
      << "coincident from, spread to";
  // A mirrored square turns as well one way as the other.
  EXPECT_TRUE(identity_rotation(
      fit({{{1, 1}, {-1, 1}}, {{-1, 1}, {1, 1}}, {{-1, -1}, {1, -1}}, {{1, -1}, {-1, -1}}})))
      << "mirrored square";
}

TEST(Procrustes, IgnoresPairsOfWeightZero) {
  const auto solution = fit({{{50, 50}, {-9, 4}, 0.0}, {{0, 0}, {1, 1}}, {{1, 0}, {1, 2}}});
  EXPECT_NEAR(solution.cost, 0.0, 1e-14);
}

TEST(Procrustes, RefusesWhatItCannotWeighOrRead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit({{{0, nan}, {1, 1}}}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {1, infinity}}}).usable());
  EXPECT_FALSE(fit({}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {1, 1}, 0.0}}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {1, 1}, -1.0}, {{1, 0}, {2, 1}}}).usable());
  EXPECT_FALSE(fit({{{0, nan}, {1, 1}}, {{1, 0}, {2, 1}}}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {infinity, 1}}, {{1, 0}, {2, 1}}}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {1, 1}, nan}, {{1, 0}, {2, 1}}}).usable());
  EXPECT_FALSE(fit({{{0, 0}, {0, 0}}, {{1e200, 0}, {1e200, 0}}}).usable());
}

}  // namespace
}  // namespace shoal::solvers
