#include "shoal/core/transform.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numbers>

namespace shoal {
namespace {

using Eigen::Vector2d;

double coordinate() {
  return 0.1 * *rc::gen::inRange(-10'000, 10'000);
}
Vector2d point() {
  const double x = coordinate();
  return {x, coordinate()};
}
Transform2 motion() {
  const double angle = 1e-3 * *rc::gen::inRange(-7'000, 7'000);
  return Transform2::from_angle(angle, point());
}

// Coordinates reach 2 km, so a few roundings are below 1e-11 m.
constexpr double tolerance = 1e-11;

bool close(const Vector2d& a, const Vector2d& b) {
  return (a - b).norm() < tolerance;
}

TEST(Transform2, TurnsCounterClockwiseAndThenMoves) {
  const auto quarter = Transform2::from_angle(std::numbers::pi / 2, {10, 20});
  EXPECT_TRUE(close(quarter * Vector2d(1, 0), {10, 21}));
  EXPECT_TRUE(close(quarter.rotate({0, 1}), {-1, 0}));
  EXPECT_NEAR(quarter.angle(), std::numbers::pi / 2, 1e-15);
}

TEST(Transform2, DefaultIsTheIdentity) {
  EXPECT_EQ(Transform2{} * Vector2d(3, 4), Vector2d(3, 4));
}

TEST(Transform2, InverseUndoesFromBothSides) {
  EXPECT_TRUE(rc::check("inverse", [] {
    const Transform2 t = motion();
    const Vector2d p = point();
    RC_ASSERT(close(t.inverse() * (t * p), p));
    RC_ASSERT(close(t * (t.inverse() * p), p));
    RC_ASSERT(close((t * t.inverse()) * p, p));
  }));
}

TEST(Transform2, ProductIsApplyingOneAfterTheOther) {
  EXPECT_TRUE(rc::check("composition", [] {
    const Transform2 a = motion();
    const Transform2 b = motion();
    const Transform2 c = motion();
    const Vector2d p = point();
    RC_ASSERT(close((a * b) * p, a * (b * p)));
    RC_ASSERT(close(((a * b) * c) * p, (a * (b * c)) * p));
    RC_ASSERT(close((a * b).inverse() * p, (b.inverse() * a.inverse()) * p));
  }));
}

TEST(Transform2, KeepsDistancesAndHandedness) {
  EXPECT_TRUE(rc::check("rigid", [] {
    const Transform2 t = motion();
    const Vector2d p = point();
    const Vector2d q = point();
    RC_ASSERT(std::abs((t * p - t * q).norm() - (p - q).norm()) < tolerance);
    const Vector2d x = t.rotate(Vector2d::UnitX());
    const Vector2d y = t.rotate(Vector2d::UnitY());
    RC_ASSERT(std::abs(x.x() * y.y() - x.y() * y.x() - 1.0) < 1e-14);
  }));
}

}  // namespace
}  // namespace shoal
