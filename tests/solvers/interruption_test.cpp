#include "shoal/core/interruption.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/matching/rigid_matching.hpp"

namespace shoal::solvers {
namespace {

struct Enough {};

/// Ends work after so many checks.
Interruption after(int checks) {
  return Interruption([left = checks]() mutable {
    if (--left < 0) throw Enough();
  });
}

std::vector<Eigen::Vector2d> scattered(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 1000.0);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(place(random), place(random));
  return points;
}

TEST(Interruption, EndsAMatchWhereverItIsAndLeavesNoTrace) {
  const auto points = scattered(80, 1), slots = scattered(100, 2);
  const auto sampled = [] {
    return Registry<Matcher>::instance().make("sampled", Setting{}, "matching.sampled");
  };
  const MatchingProblem problem{.points = points, .slots = slots};
  const double expected = sampled()->solve(problem).cost;
  for (const int checks : {0, 1, 10, 100, 300}) {
    const auto matcher = sampled();
    {
      const Interruption interruption = after(checks);
      EXPECT_THROW(matcher->solve(problem), Enough) << checks;
    }
    EXPECT_EQ(matcher->solve(problem).cost, expected) << checks;
  }
}

TEST(Interruption, EndsARigidMatchWhileItIsMadeAndWhileItSearches) {
  const auto points = scattered(20, 3), slots = scattered(200, 4);
  {
    const Interruption interruption = after(100);
    EXPECT_THROW(RigidMatching(slots, {}), Enough);
  }
  RigidMatching matching(slots, {});
  const double expected = matching.match(points, std::nullopt).mean_m;
  {
    const Interruption interruption = after(1);
    EXPECT_THROW(matching.match(points, std::nullopt), Enough);
  }
  EXPECT_EQ(RigidMatching(slots, {}).match(points, std::nullopt).mean_m, expected);
}

TEST(Matching, RefusesMoreWorkThanItDoes) {
  const auto points = scattered(3000, 5);
  const MatchingProblem problem{.points = points, .slots = points};
  const auto with = [](double step_deg) {
    Setting options;
    options.at_or_new("delta_theta_deg").value = step_deg;
    return Registry<Matcher>::instance().make("sampled", options, "matching.sampled");
  };
  EXPECT_FALSE(with(10.0)->refuses(problem));
  const auto why = with(1.0)->refuses(problem);
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("at most 1e+09 points x rotations x slots"), std::string::npos) << *why;
}

}  // namespace
}  // namespace shoal::solvers
