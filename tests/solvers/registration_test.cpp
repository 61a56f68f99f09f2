// What holds for every registered solver of the family with every loss.

#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/matching/points.hpp"

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
#include "tests/solvers/registration_support.hpp"

namespace shoal::solvers {
namespace {

using namespace tests;
using Eigen::Vector2d;

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
class EveryRegistration : public EveryCombination {};

TEST_P(EveryCombination, IsSolvedOrExplained) {
  const Pairs pairs = lattice();
  const RegistrationSolution solution = fit(pairs);
  if (!with->refuses({{}, of.get()})) {
    EXPECT_TRUE(is(solution, Status::converged));
    EXPECT_NEAR(solution.T_to_from.angle(), 0.7, 0.01);
    EXPECT_NEAR(solution.cost, cost_of(solution.T_to_from, pairs, *of), 1e-9 * solution.cost);
    return;
  }
  EXPECT_TRUE(is(solution, Status::bad_input));
  EXPECT_TRUE(std::isnan(solution.cost));
  EXPECT_TRUE(std::isnan(solution.T_to_from.cosine));
  EXPECT_TRUE(solution.T_to_from.translation.array().isNaN().all());
  const std::string why = *with->refuses({pairs, of.get()});
  for (const std::string& other : Registry<RegistrationSolver>::instance().names()) {
    const bool named = why.find(other) != std::string::npos;
    EXPECT_EQ(named, !solver(other)->refuses({pairs, of.get()})) << other << ": " << why;
  }
}

TEST_P(EveryRegistration, IsTheIdentityForIdenticalPoints) {
  const RegistrationSolution solution =
      fit({{{3, 4}, {3, 4}}, {{-5, 1}, {-5, 1}}, {{7, -2}, {7, -2}}});
  EXPECT_TRUE(is(solution, Status::converged));
  EXPECT_NEAR(solution.T_to_from.angle(), 0.0, 1e-12);
  EXPECT_NEAR(solution.T_to_from.translation.norm(), 0.0, 1e-12);
}

TEST_P(EveryRegistration, AnswersDegenerateSetsWithAStatus) {
  const auto only_moved = [&](const Pairs& pairs) {
    const RegistrationSolution solution = fit(pairs);
    EXPECT_TRUE(is(solution, Status::undetermined));
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
  EXPECT_TRUE(is(line, Status::converged)) << "collinear";
  EXPECT_NEAR(line.T_to_from.angle(), radians(90.0), 1e-9);
}

TEST_P(EveryRegistration, RefusesWhatItCannotWeighOrRead) {
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
    EXPECT_TRUE(is(solution, Status::bad_input)) << wrong.size() << " pairs";
    EXPECT_TRUE(std::isnan(solution.T_to_from.translation.x()));
  }
}

TEST_P(EveryRegistration, MovesWithItsPointsAndIgnoresTheirOrderAndTheScaleOfTheWeights) {
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
        std::rotate(other.begin(), other.begin() + 2, other.end());
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

TEST_P(EveryRegistration, NeverAnswersWithAReflection) {
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

TEST_P(EveryRegistration, KeepsItsDigitsFarFromTheOrigin) {
  const Vector2d away(1e6, -1e6);
  const Pairs near = lattice();
  const Pairs far = lattice(0.0, Vector2d(40, -70) + away);
  const Transform2 here = fit(near).T_to_from;
  Transform2 there = fit(far).T_to_from;
  there.translation -= away;
  EXPECT_LT(apart(here, there, near), 1e-6);
}

TEST_P(EveryRegistration, FindsAnyAngle) {
  for (int deg = -360; deg <= 360; deg += 15) {
    const auto motion = Transform2::from_angle(radians(deg), {5, 6});
    Pairs pairs = lattice();
    for (PointPair& p : pairs) p.to = motion * p.from;
    pairs[3].to += Vector2d(2, 1);
    const RegistrationSolution solution = fit(pairs);
    EXPECT_TRUE(is(solution, Status::converged)) << deg;
    EXPECT_NEAR(wrapped(solution.T_to_from.angle() - motion.angle()), 0.0, 5e-3) << deg;
  }
}

TEST_P(EveryRegistration, GivesTwoThreadsTheSameBits) {
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
INSTANTIATE_TEST_SUITE_P(Registration, EveryRegistration, testing::ValuesIn(combinations(true)),
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
    EXPECT_TRUE(is(solution, Status::converged)) << name;
    EXPECT_NEAR(solution.cost, 2.0, 1e-12) << name;
    EXPECT_NEAR(solution.T_to_from.angle(), radians(90.0), 1e-9) << name;
    EXPECT_LT((solution.T_to_from.translation - Vector2d(3, 4)).norm(), 1e-9) << name;
    EXPECT_EQ(solution.evaluations > 0, name != "procrustes") << name;
  }
}

}  // namespace
}  // namespace shoal::solvers
