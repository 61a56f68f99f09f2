#include "shoal/formations/obstacle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "shoal/core/angles.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/formations/obstacles/shapes.hpp"
#include "tests/formations/swarm.hpp"
#include "tests/support/reference_table.hpp"

namespace shoal::formations {
namespace {

using namespace tests;
using std::numbers::pi;

std::unique_ptr<Obstacle> obstacle(const std::string& kind, Table options = {}) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, Setting{value, {}});
  return Registry<Obstacle>::instance().make(kind, table, "test");
}

/// Of each shape, a slender one and one that is nearly round, at a place and an angle.
struct Shapes {
  const char* name;
  std::function<std::unique_ptr<Obstacle>(const Vector2d& centre, double angle)> at;
  std::function<Vector2d(double share)> edge;  ///< in its own frame, once round for 0 to 1
};

Vector2d on_rectangle(double share, double a, double b) {
  const double s = 4.0 * share;
  if (s < 1.0) return {a, b * (2.0 * s - 1.0)};
  if (s < 2.0) return {a * (3.0 - 2.0 * s), b};
  if (s < 3.0) return {-a, b * (5.0 - 2.0 * s)};
  return {a * (2.0 * s - 7.0), -b};
}

Shapes rectangles(const char* name, double a, double b) {
  return {
      name,
      [=](const Vector2d& c, double angle) { return std::make_unique<Rectangle>(c, a, b, angle); },
      [=](double share) { return on_rectangle(share, a, b); }};
}
Shapes ellipses(const char* name, double a, double b) {
  return {
      name,
      [=](const Vector2d& c, double angle) { return std::make_unique<Ellipse>(c, a, b, angle); },
      [=](double share) {
        return Vector2d(a * std::cos(2 * pi * share), b * std::sin(2 * pi * share));
      }};
}
const Shapes shapes[] = {
    {"circle", [](const Vector2d& c, double) { return std::make_unique<Circle>(c, 12.0); },
     [](double share) {
       return Vector2d(12 * std::cos(2 * pi * share), 12 * std::sin(2 * pi * share));
     }},
    rectangles("rectangle", 22, 8),
    rectangles("upright_rectangle", 7, 9),
    ellipses("ellipse", 22, 8),
    ellipses("upright_ellipse", 7, 9),
    ellipses("thin_ellipse", 50, 0.5),
    ellipses("round_ellipse", 9, 9),
};

/// Places around the origin, inside and out, off the axes.
Points places_around() {
  Points all;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.3 + 2.4 * i;
    const double r = 0.7 + 1.1 * i;
    all.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return all;
}

class EveryShape : public testing::TestWithParam<Shapes> {};

TEST_P(EveryShape, HasNoPointOfItsEdgeNearerThanTheNearest) {
  const auto shape = GetParam().at({0, 0}, 0.0);
  for (const Vector2d& place : places_around()) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20'000; ++i) {
      least = std::min(least, (GetParam().edge(i / 20'000.0) - place).norm());
    }
    const Proximity near = shape->nearest(place);
    EXPECT_LE(std::abs(near.distance), least + 1e-12);
    EXPECT_GT(std::abs(near.distance), least - 0.01);
  }
}

TEST_P(EveryShape, HasNoDistanceOnItsEdge) {
  const auto shape = GetParam().at({0, 0}, 0.0);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_NEAR(shape->nearest(GetParam().edge(i / 1000.0)).distance, 0.0, 1e-13);
  }
  for (const Vector2d& place : places_around()) {
    const Vector2d foot = shape->nearest(place).closest(place);
    EXPECT_NEAR(shape->nearest(foot).distance, 0.0, 1e-13);
  }
}

TEST_P(EveryShape, HasTheNormalAsGradientAndTheCurvatureAsHessianOfItsDistance) {
  const auto shape = GetParam().at({3, -4}, 0.6);
  for (const Vector2d& relative : places_around()) {
    const Vector2d place = relative + Vector2d(3, -4);
    const Proximity near = shape->nearest(place);
    EXPECT_NEAR(near.normal.norm(), 1.0, 1e-14);
    const double h = 1e-5 / std::max(1.0, near.curvature);
    const Eigen::Matrix2d hessian =
        near.curvature * (Eigen::Matrix2d::Identity() - near.normal * near.normal.transpose());
    for (int i = 0; i < 2; ++i) {
      const Vector2d step = h * Vector2d::Unit(i);
      const Proximity more = shape->nearest(place + step);
      const Proximity less = shape->nearest(place - step);
      EXPECT_NEAR((more.distance - less.distance) / (2 * h), near.normal[i], 2e-8) << relative;
      const Vector2d bend = (more.normal - less.normal) / (2 * h);
      EXPECT_LT((bend - hessian.col(i)).norm(), 1e-6 * (1.0 + near.curvature)) << relative;
    }
  }
}

TEST_P(EveryShape, IsNegativeInsideAndPointsOut) {
  const auto shape = GetParam().at({0, 0}, 0.0);
  for (int i = 0; i < 97; ++i) {
    const Vector2d edge = GetParam().edge(i / 97.0);
    EXPECT_LT(shape->nearest(0.99 * edge).distance, 0.0);
    EXPECT_GT(shape->nearest(1.01 * edge).distance, 0.0);
    EXPECT_GT(shape->nearest(1.01 * edge).normal.dot(edge), 0.0);
    EXPECT_GT(shape->nearest(0.99 * edge).normal.dot(edge), 0.0);
  }
}

TEST_P(EveryShape, IsMovedAndTurnedWithTheWorld) {
  const auto here = GetParam().at({0, 0}, 0.0);
  const Transform2 T_world_shape = Transform2::from_angle(-2.2, {310, -45});
  const auto there = GetParam().at(T_world_shape.translation, -2.2);
  EXPECT_EQ(there->centre(), T_world_shape.translation);
  for (const Vector2d& place : places_around()) {
    const Proximity a = here->nearest(place);
    const Proximity b = there->nearest(T_world_shape * place);
    EXPECT_NEAR(a.distance, b.distance, 1e-12);
    EXPECT_LT((T_world_shape.rotate(a.normal) - b.normal).norm(), 1e-10);
    EXPECT_NEAR(a.curvature, b.curvature, 1e-9 * (1.0 + a.curvature));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(shapes),
                         [](const auto& tested) { return tested.param.name; });

TEST(ObstacleReference, AgreesWithBruteForceOf35Digits) {
  const shoal::tests::ReferenceTable table(
      "obstacle_geometry.csv", {"shape", "cx", "cy", "a_or_r", "b", "psi", "px", "py",
                                "signed_distance", "nx", "ny", "closest_x", "closest_y", "unique"});
  ASSERT_EQ(table.rows(), 100u);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](const char* column) { return table.number(row, column); };
    const Vector2d centre(number("cx"), number("cy"));
    const double a = number("a_or_r"), b = number("b"), psi = number("psi");
    std::unique_ptr<Obstacle> shape;
    if (table.text(row, "shape") == "circle") shape = std::make_unique<Circle>(centre, a);
    if (table.text(row, "shape") == "rectangle") {
      shape = std::make_unique<Rectangle>(centre, a, b, psi);
    }
    if (table.text(row, "shape") == "ellipse") shape = std::make_unique<Ellipse>(centre, a, b, psi);
    ASSERT_TRUE(shape) << table.line(row);

    const Vector2d place(number("px"), number("py"));
    const Proximity near = shape->nearest(place);
    EXPECT_NEAR(near.distance, number("signed_distance"), 1e-9) << table.line(row);
    EXPECT_EQ(near.unique, number("unique") == 1.0) << table.line(row);
    if (near.unique) {
      const Vector2d normal(number("nx"), number("ny"));
      const Vector2d closest(number("closest_x"), number("closest_y"));
      EXPECT_LT((near.normal - normal).norm(), 1e-9) << table.line(row);
      EXPECT_LT((near.closest(place) - closest).norm(), 1e-9) << table.line(row);
    }
  }
}

void expect_near(const Proximity& near, double distance, const Vector2d& normal, bool unique) {
  EXPECT_NEAR(near.distance, distance, 1e-14);
  EXPECT_LT((near.normal - normal).norm(), 1e-14) << near.normal.transpose();
  EXPECT_EQ(near.unique, unique);
  EXPECT_TRUE(std::isfinite(near.curvature));
}

TEST(Circle, PointsAlongXInItsMiddle) {
  expect_near(Circle({5, 6}, 3).nearest({5, 6}), -3, {1, 0}, false);
}

TEST(Rectangle, TakesTheEndsBeforeTheSidesAndThePositiveOfTwo) {
  const Rectangle shape({0, 0}, 8, 4, 0.0);
  expect_near(shape.nearest({7, 3}), -1, {1, 0}, false);
  expect_near(shape.nearest({-7, 3}), -1, {-1, 0}, false);
  expect_near(shape.nearest({-2, 0}), -4, {0, 1}, false);
  expect_near(shape.nearest({0, 0}), -4, {0, 1}, false);
  expect_near(shape.nearest({5, 0}), -3, {1, 0}, true);
  expect_near(Rectangle({0, 0}, 4, 4, 0.0).nearest({0, 0}), -4, {1, 0}, false);
}

TEST(Rectangle, HasANormalOnItsEdgeAndInItsCorners) {
  const Rectangle shape({0, 0}, 8, 4, 0.0);
  expect_near(shape.nearest({8, 1}), 0, {1, 0}, true);
  expect_near(shape.nearest({-3, -4}), 0, {0, -1}, true);
  expect_near(shape.nearest({8, 4}), 0, {1, 0}, false);
  expect_near(shape.nearest({11, 8}), 5, {0.6, 0.8}, true);
  EXPECT_NEAR(shape.nearest({11, 8}).curvature, 1.0 / 5.0, 1e-15);
  EXPECT_EQ(shape.nearest({1, 8}).curvature, 0.0);
}

TEST(Rectangle, KnowsTwoNearestSidesAlsoWhenItIsTurned) {
  const Transform2 turn = Transform2::from_angle(0.7, {100, -50});
  const Rectangle shape(turn.translation, 8, 4, 0.7);
  for (const Vector2d& p : {Vector2d(7, 3), Vector2d(-2, 0), Vector2d(8, 4), Vector2d(-6, -2)}) {
    EXPECT_FALSE(shape.nearest(turn * p).unique) << p.transpose();
  }
  for (const Vector2d& p : {Vector2d(7, 3.001), Vector2d(-2, 0.001), Vector2d(8.001, 4.001)}) {
    EXPECT_TRUE(shape.nearest(turn * p).unique) << p.transpose();
  }
}

// a = 5, b = 4: the centre of curvature of its end is at (a^2 - b^2) / a = 1.8.
TEST(Ellipse, HasTwoNearestPointsBetweenTheCentresOfCurvatureOfItsEnds) {
  const Ellipse shape({0, 0}, 5, 4, 0.0);
  expect_near(shape.nearest({0, 0}), -4, {0, 1}, false);
  expect_near(shape.nearest({1.8, 0}), -3.2, {1, 0}, true);
  expect_near(shape.nearest({4, 0}), -1, {1, 0}, true);
  expect_near(shape.nearest({-7, 0}), 2, {-1, 0}, true);
  expect_near(shape.nearest({0, -2}), -2, {0, -1}, true);
  // x_e = a^2 X / (a^2 - b^2) = 25/9 for X = 1, and y_e = b sqrt(1 - (5/9)^2) = 4 sqrt(56) / 9.
  const Proximity near = shape.nearest({1, 0});
  EXPECT_FALSE(near.unique);
  EXPECT_LT((near.closest({1, 0}) - Vector2d(25.0 / 9.0, 4.0 * std::sqrt(56.0) / 9.0)).norm(),
            1e-14);
  EXPECT_NEAR(near.distance, -std::hypot(16.0 / 9.0, 4.0 * std::sqrt(56.0) / 9.0), 1e-14);
}

TEST(Ellipse, IsContinuousAcrossItsLongerAxis) {
  const Ellipse shape({0, 0}, 5, 4, 0.0);
  for (const double x : {0.0, 1.0, 1.79, 1.81, 3.0, 8.0}) {
    for (const double y : {1e-3, 1e-6, 1e-12, 1e-200, 1e-320}) {
      const Proximity on = shape.nearest({x, 0});
      const Proximity above = shape.nearest({x, y});
      EXPECT_NEAR(above.distance, on.distance, y + 1e-14);
      EXPECT_LT((above.normal - on.normal).norm(), 200 * y + 1e-13) << x << ' ' << y;
    }
  }
}

TEST(Ellipse, IsACircleIfItsAxesAreEqual) {
  const Ellipse ellipse({1, 2}, 9, 9, 0.3);
  const Circle circle({1, 2}, 9);
  for (const Vector2d& place : places_around()) {
    EXPECT_NEAR(ellipse.nearest(place).distance, circle.nearest(place).distance, 1e-13);
    EXPECT_LT((ellipse.nearest(place).normal - circle.nearest(place).normal).norm(), 1e-13);
  }
  EXPECT_NEAR(ellipse.nearest({1, 2}).distance, -9, 1e-14);
  EXPECT_FALSE(ellipse.nearest({1, 2}).unique);
}

TEST(ObstacleOptions, TakeCompassHeadings) {
  for (const char* kind : {"rectangle", "ellipse"}) {
    const auto north = obstacle(
        kind,
        {{"half_length_m", 30.0}, {"half_width_m", 5.0}, {"heading_deg", 0.0}, {"x_m", 100.0}});
    EXPECT_NEAR(north->nearest({100, 40}).distance, 10.0, 1e-12);
    EXPECT_NEAR(north->nearest({140, 0}).distance, 35.0, 1e-12);
  }
}

TEST(ObstacleOptions, RefuseShapesWithoutSize) {
  EXPECT_THROW(obstacle("circle", {{"radius_m", 0.0}}), InputError);
  for (const char* kind : {"rectangle", "ellipse"}) {
    EXPECT_THROW(obstacle(kind, {{"half_length_m", -1.0}}), InputError);
    EXPECT_THROW(obstacle(kind, {{"half_width_m", 0.0}}), InputError);
  }
}

}  // namespace
}  // namespace shoal::formations
