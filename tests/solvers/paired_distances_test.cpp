#include "shoal/solvers/matching/paired_distances.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numbers>

#include "tests/solvers/matching_support.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

Points any_points(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(*rc::gen::inRange(-500, 501), *rc::gen::inRange(-500, 501));
  }
  return points;
}

TEST(PairedDistances, FindTheMotionThatTargetsWereMovedBy) {
  const Points points = tests::centred(tests::lattice(3, 4, 300.0));
  const Transform2 T = Transform2::from_angle(2.5, {700.0, -90.0});
  const Points targets = tests::moved(points, T);
  PairedDistances pairs;
  pairs.set(points, targets);
  const auto least = pairs.least({0.0, {0.0, 0.0}}, 0.01);
  EXPECT_LT(least.sum, 1e-6);
  EXPECT_NEAR(std::cos(least.pose.angle - 2.5), 1.0, 1e-12);
  EXPECT_NEAR((least.pose.place - T.translation).norm(), 0.0, 1e-6);
}

TEST(PairedDistances, AreIndifferentToOnePairThatIsFarOff) {
  Points points = tests::centred(tests::lattice(3, 3, 100.0));
  Points targets = points;
  targets[4] += Vector2d(300.0, 0.0);
  PairedDistances pairs;
  pairs.set(points, targets);
  const auto least = pairs.least({}, 1e-3);
  EXPECT_NEAR(least.sum, 300.0, 1e-3) << "unlike a sum of squares";
  EXPECT_NEAR(least.pose.place.norm(), 0.0, 1e-3);
}

TEST(PairedDistances, BoundTheSumOfEveryMotion) {
  EXPECT_TRUE(rc::check("the bound holds, and is close", [] {
    const int count = *rc::gen::inRange(1, 8);
    const Points points = tests::centred(any_points(count)), targets = any_points(count);
    PairedDistances pairs;
    pairs.set(points, targets);
    const double slack = 0.01 * count;
    const auto least = pairs.least({0.3, {0.0, 0.0}}, slack);
    RC_ASSERT(least.bound_below <= least.sum);
    RC_ASSERT(least.sum - least.bound_below <= slack + 1e-9);
    RC_ASSERT(std::abs(pairs.sum(least.pose) - least.sum) < 1e-9);
    for (int k = 0; k < 72; ++k) {
      const RigidPose local = pairs.descended({k * std::numbers::pi / 36.0, least.pose.place});
      RC_ASSERT(pairs.sum(local) >= least.bound_below - 1e-9);
      const RigidPose any{k * 0.1, Vector2d(*rc::gen::inRange(-500, 501), 10.0 * k)};
      RC_ASSERT(pairs.sum(any) >= least.bound_below);
    }
  }));
}

TEST(PairedDistances, TakePointsInOnePlace) {
  const Points points(3, Vector2d(0, 0)), targets = {{0, 0}, {100, 0}, {0, 100}};
  PairedDistances pairs;
  pairs.set(points, targets);
  const auto least = pairs.least({}, 1e-3);
  // The geometric median of a right-angled isosceles triangle.
  EXPECT_NEAR(least.sum, 100.0 * (1.0 + std::sqrt(3.0)) / std::sqrt(2.0), 1e-3);
  EXPECT_GE(least.bound_below, least.sum - 1e-3);
}

}  // namespace
}  // namespace shoal::solvers
