#pragma once

#include <memory>

#include "shoal/core/angles.hpp"
#include "shoal/formations/obstacles/shapes.hpp"

namespace shoal::formations {

/// The options of a shape with two half axes.
template <class Shape>
struct Oblong {
  double x_m = 0.0;
  double y_m = 0.0;
  double half_length_m = 50.0;
  double half_width_m = 25.0;
  double heading_deg = 90.0;

  static void declare(Options<Oblong>& o) {
    using S = Oblong;
    o.number("x_m", &S::x_m, "m", {}, "east, of the centre");
    o.number("y_m", &S::y_m, "m", {}, "north, of the centre");
    o.number("half_length_m", &S::half_length_m, "m", above(0),
             "half of its size along its heading");
    o.number("half_width_m", &S::half_width_m, "m", above(0), "half of its size across");
    o.number("heading_deg", &S::heading_deg, "deg", in(-360, 360),
             "compass heading of its length; 90: along x");
  }

  std::unique_ptr<Shape> made() const {
    return std::make_unique<Shape>(Eigen::Vector2d(x_m, y_m), half_length_m, half_width_m,
                                   from_compass_deg(heading_deg));
  }
};

}  // namespace shoal::formations
