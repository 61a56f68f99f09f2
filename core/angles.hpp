#pragma once

#include <cmath>
#include <numbers>

namespace shoal {

// Angles inside are mathematical: radians, counter-clockwise from x (east). Compass degrees,
// clockwise from north, exist at the edges only.

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}
constexpr double degrees(double radians) {
  return radians * (180.0 / std::numbers::pi);
}

/// The same angle in [-pi, pi].
inline double wrapped(double angle) {
  const bool inside = std::abs(angle) <= std::numbers::pi;  // most are, and remainder() is slow
  return inside ? angle : std::remainder(angle, 2.0 * std::numbers::pi);
}

inline double from_compass_deg(double compass_deg) {
  return radians(90.0 - compass_deg);
}

/// Compass degrees in [0, 360).
inline double to_compass_deg(double angle) {
  const double compass = std::fmod(90.0 - degrees(angle), 360.0);
  const double positive = compass < 0.0 ? compass + 360.0 : compass;
  return positive < 360.0 ? positive : 0.0;  // the sum of a tiny negative one rounds to 360
}

}  // namespace shoal
