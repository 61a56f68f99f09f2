#include "shoal/formations/obstacles/shapes.hpp"

namespace shoal::formations {

// Barisic et al. 2011, eq. 46-47; also inside, where the distance is negative.
Proximity Circle::nearest(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d away = place - centre_;
  const double r = away.norm();
  if (!(r > 0.0)) return {.distance = -radius_, .unique = false};
  return {.distance = r - radius_, .normal = away / r, .curvature = 1.0 / r};
}

namespace {

struct CircleOptions {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 15.0;

  static void declare(Options<CircleOptions>& o) {
    o.number("x_m", &CircleOptions::x_m, "m", {}, "east, of the centre");
    o.number("y_m", &CircleOptions::y_m, "m", {}, "north, of the centre");
    o.number("radius_m", &CircleOptions::radius_m, "m", above(0), "radius");
  }
};

const Register<Obstacle, CircleOptions> registered{
    "circle", "a disc (Barisic et al. 2011, eq. 46-47)", [](const CircleOptions& options) {
      return std::make_unique<Circle>(Eigen::Vector2d(options.x_m, options.y_m), options.radius_m);
    }};

}  // namespace
}  // namespace shoal::formations
