#pragma once

// The costs, residuals and constraints of the known problems, in the order of known_problems().
// Their sources and answers stand there.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "shoal/solvers/taylor.hpp"

namespace shoal::solvers::tests::costs {

using Eigen::Vector2d;
using std::numbers::pi;

template <class T>
T squared(const T& x) {
  return x * x;
}

struct Exponential {
  template <class T>
  T operator()(const T* x) const {
    using std::exp;
    return exp(x[0]) - 2.0 * x[0];
  }
};

struct Rosenbrock {
  template <class T>
  T operator()(const T* x) const {
    return 100.0 * squared(x[1] - x[0] * x[0]) + squared(1.0 - x[0]);
  }
};

struct TiltedBowl {
  template <class T>
  T operator()(const T* x) const {
    const double c = std::cos(pi / 6), s = std::sin(pi / 6);
    const T east = x[0] - 3.0, north = x[1] + 2.0;
    return squared(c * east + s * north) + 1e6 * squared(c * north - s * east);
  }
};

struct Beale {
  static constexpr int block_size = 1;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    constexpr std::array y{1.5, 2.25, 2.625};
    T power = x[1];
    for (int k = 0; k < i; ++k) power = power * x[1];
    r[0] = y[static_cast<std::size_t>(i)] - x[0] * (1.0 - power);
  }
};

struct Himmelblau {
  template <class T>
  T operator()(const T* x) const {
    return squared(x[0] * x[0] + x[1] - 11.0) + squared(x[0] + x[1] * x[1] - 7.0);
  }
};

struct GoldsteinPrice {
  template <class T>
  T operator()(const T* p) const {
    const T &x = p[0], &y = p[1];
    const T first = 19.0 - 14.0 * x + 3.0 * x * x - 14.0 * y + 6.0 * x * y + 3.0 * y * y;
    const T second = 18.0 - 32.0 * x + 12.0 * x * x + 48.0 * y - 36.0 * x * y + 27.0 * y * y;
    return (1.0 + squared(x + y + 1.0) * first) * (30.0 + squared(2.0 * x - 3.0 * y) * second);
  }
};

struct McCormick {
  template <class T>
  T operator()(const T* x) const {
    using std::sin;
    return sin(x[0] + x[1]) + squared(x[0] - x[1]) - 1.5 * x[0] + 2.5 * x[1] + 1.0;
  }
};

struct Branin {
  template <class T>
  T operator()(const T* x) const {
    using std::cos;
    return squared(x[1] - 5.1 / (4.0 * pi * pi) * x[0] * x[0] + 5.0 / pi * x[0] - 6.0) +
           10.0 * (1.0 - 1.0 / (8.0 * pi)) * cos(x[0]) + 10.0;
  }
};

struct SixHumpCamel {
  template <class T>
  T operator()(const T* p) const {
    const T x2 = p[0] * p[0], y2 = p[1] * p[1];
    return (4.0 - 2.1 * x2 + x2 * x2 / 3.0) * x2 + p[0] * p[1] + (4.0 * y2 - 4.0) * y2;
  }
};

struct HelicalValley {
  static constexpr int block_size = 1;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    using std::atan;
    using std::sqrt;
    if (i == 0) {
      const T turns = atan(x[1] / x[0]) / (2.0 * pi) + (x[0] < T(0.0) ? 0.5 : 0.0);
      r[0] = 10.0 * (x[2] - 10.0 * turns);
    } else if (i == 1) {
      r[0] = 10.0 * (sqrt(x[0] * x[0] + x[1] * x[1]) - 1.0);
    } else {
      r[0] = x[2];
    }
  }
};

struct BoxThreeDimensional {
  static constexpr int block_size = 1;
  int blocks() const { return 10; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    using std::exp;
    const double t = 0.1 * (i + 1);
    r[0] = exp(-t * x[0]) - exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-10.0 * t));
  }
};

struct Bard {
  static constexpr int block_size = 1;
  int blocks() const { return 15; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    constexpr std::array y{0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39,
                           0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39};
    const double u = i + 1.0, v = 15.0 - i;
    r[0] = y[static_cast<std::size_t>(i)] - x[0] - u / (v * x[1] + std::min(u, v) * x[2]);
  }
};

struct Gaussian {
  static constexpr int block_size = 1;
  int blocks() const { return 15; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    using std::exp;
    constexpr std::array y{0.0009, 0.0044, 0.0175, 0.0540, 0.1295, 0.2420, 0.3521, 0.3989};
    const int row = std::min(i, 14 - i);
    r[0] =
        x[0] * exp(-0.5 * x[1] * squared(0.5 * (7 - i) - x[2])) - y[static_cast<std::size_t>(row)];
  }
};

struct Wood {
  static constexpr int block_size = 1;
  int blocks() const { return 6; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    switch (i) {
      case 0:
        r[0] = 10.0 * (x[1] - x[0] * x[0]);
        break;
      case 1:
        r[0] = 1.0 - x[0];
        break;
      case 2:
        r[0] = std::sqrt(90.0) * (x[3] - x[2] * x[2]);
        break;
      case 3:
        r[0] = 1.0 - x[2];
        break;
      case 4:
        r[0] = std::sqrt(10.0) * (x[1] + x[3] - 2.0);
        break;
      default:
        r[0] = (x[1] - x[3]) / std::sqrt(10.0);
    }
  }
};

struct PowellSingular {
  static constexpr int block_size = 1;
  int blocks() const { return 4; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    switch (i) {
      case 0:
        r[0] = x[0] + 10.0 * x[1];
        break;
      case 1:
        r[0] = std::sqrt(5.0) * (x[2] - x[3]);
        break;
      case 2:
        r[0] = squared(x[1] - 2.0 * x[2]);
        break;
      default:
        r[0] = std::sqrt(10.0) * squared(x[0] - x[3]);
    }
  }
};

struct ExtendedRosenbrock {
  static constexpr int block_size = 2;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* all, T* r) const {
    const T* x = all + 2 * i;
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
  }
};

struct HockSchittkowski4 {
  template <class T>
  T operator()(const T* x) const {
    return squared(x[0] + 1.0) * (x[0] + 1.0) / 3.0 + x[1];
  }
};

struct RosenbrockChain {
  template <class T>
  T operator()(const T* x) const {
    return Rosenbrock{}(x) + Rosenbrock{}(x + 1);
  }
};

struct HockSchittkowski11 {
  template <class T>
  T operator()(const T* x) const {
    return squared(x[0] - 5.0) + x[1] * x[1] - 25.0;
  }
};
struct AboveAParabola {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = x[1] - x[0] * x[0];
  }
};

struct HockSchittkowski24 {
  template <class T>
  T operator()(const T* x) const {
    return (squared(x[0] - 3.0) - 9.0) * x[1] * x[1] * x[1] / (27.0 * std::sqrt(3.0));
  }
};
struct ATriangle {
  static constexpr int block_size = 1;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* x, T* g) const {
    const double root = std::sqrt(3.0);
    if (i == 0) g[0] = x[0] / root - x[1];
    if (i == 1) g[0] = x[0] + root * x[1];
    if (i == 2) g[0] = 6.0 - x[0] - root * x[1];
  }
};

struct HockSchittkowski29 {
  template <class T>
  T operator()(const T* x) const {
    return -x[0] * x[1] * x[2];
  }
};
struct AnEllipsoid {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = 48.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - 4.0 * x[2] * x[2];
  }
};

struct HockSchittkowski35 {
  template <class T>
  T operator()(const T* x) const {
    return 9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2] + 2.0 * x[0] * x[0] + 2.0 * x[1] * x[1] +
           x[2] * x[2] + 2.0 * x[0] * x[1] + 2.0 * x[0] * x[2];
  }
};
struct BelowAPlane {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = 3.0 - x[0] - x[1] - 2.0 * x[2];
  }
};

struct RosenSuzuki {
  template <class T>
  T operator()(const T* x) const {
    return x[0] * x[0] + x[1] * x[1] + 2.0 * x[2] * x[2] + x[3] * x[3] - 5.0 * x[0] - 5.0 * x[1] -
           21.0 * x[2] + 7.0 * x[3];
  }
};
struct RosenSuzukiConstraints {
  static constexpr int block_size = 1;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* x, T* g) const {
    const T a = x[0] * x[0], b = x[1] * x[1], c = x[2] * x[2], d = x[3] * x[3];
    if (i == 0) g[0] = 8.0 - a - b - c - d - x[0] + x[1] - x[2] + x[3];
    if (i == 1) g[0] = 10.0 - a - 2.0 * b - c - 2.0 * d + x[0] + x[3];
    if (i == 2) g[0] = 5.0 - 2.0 * a - b - c - 2.0 * x[0] + x[1] + x[3];
  }
};

struct HockSchittkowski6 {
  template <class T>
  T operator()(const T* x) const {
    return (1.0 - x[0]) * (1.0 - x[0]);
  }
};
struct OnAParabola {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* h) const {
    h[0] = 10.0 * (x[1] - x[0] * x[0]);
  }
};

struct HockSchittkowski28 {
  template <class T>
  T operator()(const T* x) const {
    const T a = x[0] + x[1], b = x[1] + x[2];
    return a * a + b * b;
  }
};
struct OnAPlane {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* h) const {
    h[0] = x[0] + 2.0 * x[1] + 3.0 * x[2] - 1.0;
  }
};

struct HockSchittkowski40 {
  template <class T>
  T operator()(const T* x) const {
    return -x[0] * x[1] * x[2] * x[3];
  }
};
struct ThreeEqualities {
  static constexpr int block_size = 1;
  int blocks() const { return 3; }
  template <class T>
  void operator()(int i, const T* x, T* h) const {
    if (i == 0) h[0] = x[0] * x[0] * x[0] + x[1] * x[1] - 1.0;
    if (i == 1) h[0] = x[0] * x[0] * x[3] - x[2];
    if (i == 2) h[0] = x[3] * x[3] - x[1];
  }
};

/// Rypkema 2015, eq. 3.3 and 3.7: the pair potential to each neighbour, lowest at s = 300 m, and a
/// faint pull to the centroid of the neighbours.
template <std::size_t N>
struct AttractionRepulsion {
  std::array<std::array<double, 2>, N> neighbours;

  template <class T>
  T operator()(const T* p) const {
    using std::sqrt;
    const double s = 300.0, centroid_weight = 1e-5;
    T cost(0.0);
    double x_mean = 0.0, y_mean = 0.0;
    for (const auto& [x, y] : neighbours) {
      const T r2 = squared(p[0] - x) + squared(p[1] - y);
      cost = cost + 0.5 * s * s * s / r2 + sqrt(r2) - 3.0 * s;
      x_mean += x / static_cast<double>(N);
      y_mean += y / static_cast<double>(N);
    }
    return cost + centroid_weight * (squared(p[0] - x_mean) + squared(p[1] - y_mean));
  }
};

/// What a vehicle hears about its own place: five neighbours imply about the same, one does not.
struct ImpliedPlaces {
  static constexpr int block_size = 2;
  int blocks() const { return 6; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    constexpr std::array<std::array<double, 2>, 6> places{
        {{12, 3}, {-8, 9}, {4, -11}, {-3, -6}, {9, 7}, {220, -160}}};
    const auto& place = places[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < 2; ++k) r[k] = x[k] - place[k];
  }
};

constexpr double plan_radius_m = 300.0;
constexpr std::array<std::array<double, 2>, 5> slots{
    {{0, 0}, {300, 0}, {0, 300}, {300, 300}, {600, 150}}};

/// Slots of a plan turned by x[0] / radius and moved by (x[1], x[2]) onto where they were seen:
/// turned by some 25 degrees, moved by (120, -45), and a few metres beside.
struct RigidRegistration {
  static constexpr int block_size = 2;
  std::array<std::array<double, 2>, 5> seen{
      {{124.0, -48.0}, {385.9, 83.8}, {-3.8, 231.9}, {263.1, 346.7}, {605.4, 345.5}}};

  int blocks() const { return 5; }
  template <class T>
  void operator()(int i, const T* x, T* r) const {
    using std::cos;
    using std::sin;
    const T c = cos(x[0] / plan_radius_m), s = sin(x[0] / plan_radius_m);
    const auto& slot = slots[static_cast<std::size_t>(i)];
    const auto& place = seen[static_cast<std::size_t>(i)];
    r[0] = c * slot[0] - s * slot[1] + x[1] - place[0];
    r[1] = s * slot[0] + c * slot[1] + x[2] - place[1];
  }
};

struct ToAPlace {
  static constexpr int block_size = 2;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* r) const {
    r[0] = x[0] - 40.0;
    r[1] = x[1] - 60.0;
  }
};
struct ClearOfAnObstacle {
  static constexpr int block_size = 1;
  int blocks() const { return 1; }
  template <class T>
  void operator()(int, const T* x, T* g) const {
    g[0] = squared(x[0] - 10.0) + squared(x[1] - 20.0) - 100.0 * 100.0;
  }
};

}  // namespace shoal::solvers::tests::costs
