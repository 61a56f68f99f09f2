#include "shoal/formations/obstacles/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shoal/core/registry.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

double area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

struct Shape {
  const char* kind;
  const char* options;
  double area;
};

class Outline : public testing::TestWithParam<Shape> {};

TEST_P(Outline, FollowsTheEdge) {
  const Shape& shape = GetParam();
  const auto obstacle = Registry<formations::Obstacle>::instance().make(
      shape.kind, scenarios::parse_toml(shape.options, "test"), "obstacle");
  const std::vector<Eigen::Vector2d> polygon = formations::outline(*obstacle);
  const double size = std::sqrt(shape.area);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    EXPECT_NEAR(obstacle->nearest(polygon[k]).distance, 0.0, 1e-5);
    const Eigen::Vector2d middle = 0.5 * (polygon[k] + polygon[(k + 1) % polygon.size()]);
    EXPECT_NEAR(obstacle->nearest(middle).distance, 0.0, 5e-3 * size);
  }
  EXPECT_NEAR(area(polygon) / shape.area, 1.0, 5e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Outline,
    testing::Values(
        Shape{"circle", "x_m = 5\ny_m = -3\nradius_m = 20", 400.0 * std::numbers::pi},
        Shape{"rectangle",
              "x_m = 250\ny_m = 110\nhalf_length_m = 150\nhalf_width_m = 30\nheading_deg = 30",
              18000.0},
        Shape{"ellipse", "x_m = 0\ny_m = 0\nhalf_length_m = 50\nhalf_width_m = 5\nheading_deg = 77",
              250.0 * std::numbers::pi}),
    [](const auto& shape) { return std::string(shape.param.kind); });

}  // namespace
}  // namespace shoal::analysis
