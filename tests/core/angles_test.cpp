#include "shoal/core/angles.hpp"

#include <gtest/gtest.h>

#include <rapidcheck.h>

#include <numbers>

namespace shoal {
namespace {

using std::numbers::pi;

TEST(Angles, WrappedIsTheSameDirectionWithinHalfATurn) {
  EXPECT_TRUE(rc::check("wrapped", [] {
    const double angle = 1e-3 * *rc::gen::inRange(-1'000'000, 1'000'000);
    RC_ASSERT(std::abs(wrapped(angle)) <= pi);
    RC_ASSERT(std::abs(std::cos(wrapped(angle)) - std::cos(angle)) < 1e-12);
    RC_ASSERT(std::abs(std::sin(wrapped(angle)) - std::sin(angle)) < 1e-12);
  }));
  EXPECT_EQ(wrapped(0.25), 0.25);
  EXPECT_NEAR(wrapped(2 * pi + 0.25), 0.25, 1e-15);
}

TEST(Angles, DegreesAndRadiansAreInverse) {
  EXPECT_DOUBLE_EQ(radians(180.0), pi);
  EXPECT_DOUBLE_EQ(degrees(pi / 2), 90.0);
  EXPECT_DOUBLE_EQ(degrees(radians(12.5)), 12.5);
}

TEST(Angles, CompassRunsClockwiseFromNorth) {
  EXPECT_NEAR(from_compass_deg(0.0), pi / 2, 1e-15);  // north
  EXPECT_NEAR(from_compass_deg(90.0), 0.0, 1e-15);    // east
  EXPECT_NEAR(from_compass_deg(180.0), -pi / 2, 1e-15);
  EXPECT_DOUBLE_EQ(to_compass_deg(0.0), 90.0);
  EXPECT_DOUBLE_EQ(to_compass_deg(pi), 270.0);
  EXPECT_DOUBLE_EQ(to_compass_deg(-pi / 2), 180.0);
}

TEST(Angles, CompassStaysBelowAFullTurn) {
  EXPECT_TRUE(rc::check("to_compass_deg", [] {
    const double angle = 1e-3 * *rc::gen::inRange(-1'000'000, 1'000'000);
    const double compass = to_compass_deg(angle);
    RC_ASSERT(compass >= 0.0 && compass < 360.0);
    RC_ASSERT(std::abs(wrapped(from_compass_deg(compass) - angle)) < 1e-9);
  }));
  const double just_west_of_north = to_compass_deg(std::nextafter(pi / 2, 2.0));
  EXPECT_GE(just_west_of_north, 0.0);
  EXPECT_LT(just_west_of_north, 360.0);
  // The rounding of a tiny negative compass angle must not reach 360.
  EXPECT_LT(to_compass_deg(radians(90.0 + 1.5e-14)), 360.0);
}

}  // namespace
}  // namespace shoal
