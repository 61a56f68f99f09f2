#include <algorithm>
#include <cmath>

#include "shoal/formations/obstacles/oblong.hpp"

namespace shoal::formations {
namespace {

/// The nearest point of the ellipse (x/a)^2 + (y/b)^2 = 1, a >= b, and how far along the gradient
/// of its left side the place lies: place = nearest + t (x/a^2, y/b^2). Barisic et al. 2011,
/// eq. 53.
struct Foot {
  double x, y;
  double t;  // m^2; negative inside
  bool unique;
};

/// The greatest root of F(s) = (aX / (s + c))^2 + (bY / s)^2 - 1 with c = a^2 - b^2, s = t + b^2
/// and Y > 0: of the quartic 55, whose greatest root is the right one inside as well.
///
/// F falls and is convex where s > 0, so that Newton's iteration climbs to the root from below and
/// never passes it. In s, unlike in t, nothing cancels near the longer axis.
double greatest_root(double aX, double bY, double c) {
  double s = std::max(bY, aX - c);
  for (int i = 0; i < 200; ++i) {
    const double u = aX / (s + c);
    const double v = bY / s;
    const double next = s + 0.5 * (u * u + v * v - 1.0) / (u * u / (s + c) + v * v / s);
    if (!(next > s)) break;
    s = next;
  }
  return s;
}

Foot foot_of(double X, double Y, double a, double b, double rounding) {
  const double c = (a - b) * (a + b);
  const double tolerance = rounding + 1e-15 * a;
  const bool between_centres = Y <= tolerance && a * X < c;
  const bool in_the_middle = c <= tolerance * a && std::max(X, Y) <= tolerance;
  const bool unique = !between_centres && !in_the_middle;

  if (Y > 1e-100 * a) {  // below, its quotients would leave the range of numbers
    const double s = greatest_root(a * X, b * Y, c);
    return {a * a * X / (s + c), b * b * Y / s, s - b * b, unique};
  }
  if (a * X >= c) return {a, 0.0, a * (X - a), unique};
  const double x = a * a * X / c;  // two points are nearest: the one with y > 0
  return {x, b * std::sqrt(std::max(0.0, (1.0 - x / a) * (1.0 + x / a))), -b * b, unique};
}

}  // namespace

// Barisic et al. 2011, eq. 50-62, with the distance of C44 (the printed one is in m^3) and the
// normal of the ellipse (C45; printed is the radial direction). Inside (C46) the distance is
// negative.
Proximity Ellipse::nearest_in_quadrant(const Eigen::Vector2d& place, double rounding) const {
  const bool lies = half_.x() >= half_.y();
  const double a = half_.maxCoeff();
  const double b = half_.minCoeff();
  const Foot foot = lies ? foot_of(place.x(), place.y(), a, b, rounding)
                         : foot_of(place.y(), place.x(), a, b, rounding);

  const Eigen::Vector2d k(foot.x / (a * a), foot.y / (b * b));  // eq. 52
  const double steepness = k.norm();
  const double d = foot.t * steepness;
  const Eigen::Vector2d n = k / steepness;
  // The edge's radius of curvature is a^2 b^2 |k|^3; a line of equal distance has d more.
  const double radius = a * a * b * b * steepness * steepness * steepness + d;
  const bool shrunk = !(radius > 1e-15 * a);
  return {d, lies ? n : Eigen::Vector2d(n.y(), n.x()), shrunk ? 0.0 : 1.0 / radius, foot.unique};
}

namespace {

const Register<Obstacle, Oblong<Ellipse>> registered{
    "ellipse", "a turned ellipse (Barisic et al. 2011, eq. 50-62)",
    [](const Oblong<Ellipse>& options) { return options.made(); }};

}  // namespace
}  // namespace shoal::formations
