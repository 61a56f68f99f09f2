#include "tests/solvers/problems.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/least_squares.hpp"

namespace shoal::solvers::tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Vector = Problem::Vector;
using Vector1d = Eigen::Matrix<double, 1, 1>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
T squared(const T& x) {
  return x * x;
}

// The costs, in the order of known_problems() ---------------------------------------------------

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

// How they are posed ----------------------------------------------------------------------------

template <int N, class Residuals>
Problem least_squares(const Vector& start, const Residuals& residuals) {
  return least_squares_problem(start, {differentiated_blocks<N>(residuals), nullptr, {}});
}

std::shared_ptr<const Loss> loss(const std::string& kind, double scale_m) {
  Setting options;
  options.at_or_new("scale_m").value = scale_m;
  return Registry<Loss>::instance().make(kind, options, "loss." + kind);
}

Problem bounded(Problem problem, const Vector& lower, const Vector& upper) {
  problem.lower = lower;
  problem.upper = upper;
  return problem;
}

template <int N, class Constraints>
Problem constrained(Problem problem, const Constraints& constraints) {
  problem.constraints = differentiated_blocks<N>(constraints);
  return problem;
}

KnownProblem known(std::string name, std::string source, Problem problem, double best_known,
                   std::vector<Vector> minimisers) {
  problem.best_known = best_known;
  return {std::move(name), std::move(source), std::move(problem), std::move(minimisers)};
}

KnownProblem with_higher_minima(KnownProblem known) {
  known.several_minima = true;
  return known;
}

KnownProblem with_a_curve(KnownProblem known) {
  known.curve_of_minimisers = true;
  return known;
}

Vector six(double a, double b, double c, double d, double e, double f) {
  return Vector6d(a, b, c, d, e, f);
}

// "MGH": More, Garbow, Hillstrom 1981, Testing unconstrained optimization software.
// "HS": Hock, Schittkowski 1981, Test examples for nonlinear programming codes.
// Minimisers without a closed form are the roots of the gradient by Newton's iteration.

void add_smooth(std::vector<KnownProblem>& all) {
  all.push_back(known("exponential_line", "ours: d/dx = exp(x) - 2",
                      Problem(Vector1d(-1.0), differentiated<1>(Exponential{})),
                      2.0 - 2.0 * std::numbers::ln2, {Vector1d(std::numbers::ln2)}));
  all.push_back(known("rosenbrock", "Rosenbrock 1960; MGH 1",
                      Problem(Vector2d(-1.2, 1.0), differentiated<2>(Rosenbrock{})), 0.0,
                      {Vector2d(1.0, 1.0)}));
  all.push_back(known("tilted_bowl", "ours: a quadratic form of condition 1e6, axes at 30 degrees",
                      Problem(Vector2d(-20.0, 10.0), differentiated<2>(TiltedBowl{})), 0.0,
                      {Vector2d(3.0, -2.0)}));
  all.push_back(known("himmelblau", "Himmelblau 1972; the start is ours",
                      Problem(Vector2d(0.0, 0.0), differentiated<2>(Himmelblau{})), 0.0,
                      {Vector2d(3.0, 2.0), Vector2d(-2.805118086952745, 3.131312518250573),
                       Vector2d(-3.779310253377747, -3.283185991286170),
                       Vector2d(3.584428340330492, -1.848126526964404)}));
  all.push_back(
      with_higher_minima(known("goldstein_price", "Goldstein, Price 1971; the start is ours",
                               Problem(Vector2d(-0.2, -0.8), differentiated<2>(GoldsteinPrice{})),
                               3.0, {Vector2d(0.0, -1.0)})));
}

void add_least_squares(std::vector<KnownProblem>& all) {
  all.push_back(known("beale", "Beale 1958; MGH 5", least_squares<2>(Vector2d(1.0, 1.0), Beale{}),
                      0.0, {Vector2d(3.0, 0.5)}));
  all.push_back(known("helical_valley", "Fletcher, Powell 1963; MGH 7",
                      least_squares<3>(Vector3d(-1.0, 0.0, 0.0), HelicalValley{}), 0.0,
                      {Vector3d(1.0, 0.0, 0.0)}));
  // x = (a, a, 0) is as low, for any a; and towards infinity in the first two unknowns the cost
  // levels out at 0.0756, which is a flat minimum of its own.
  all.push_back(with_higher_minima(
      with_a_curve(known("box_three_dimensional", "Box 1966; MGH 12",
                         least_squares<3>(Vector3d(0.0, 10.0, 20.0), BoxThreeDimensional{}), 0.0,
                         {Vector3d(1.0, 10.0, 1.0), Vector3d(10.0, 1.0, -1.0)}))));
  all.push_back(known("bard", "Bard 1970; MGH 8", least_squares<3>(Vector3d(1.0, 1.0, 1.0), Bard{}),
                      0.0082148773065789816,
                      {Vector3d(0.082410559749788975, 1.1330360920297222, 2.3436951786425366)}));
  all.push_back(known("gaussian", "MGH 9", least_squares<3>(Vector3d(0.4, 1.0, 0.0), Gaussian{}),
                      1.127932769619216e-08,
                      {Vector3d(0.39895613783875666, 1.0000190844878056, 0.0)}));
  all.push_back(known("wood", "Colville 1968; MGH 14",
                      least_squares<4>(Vector4d(-3.0, -1.0, -3.0, -1.0), Wood{}), 0.0,
                      {Vector4d(1.0, 1.0, 1.0, 1.0)}));
  all.push_back(known("powell_singular", "Powell 1962; MGH 13: the Hessian is singular there",
                      least_squares<4>(Vector4d(3.0, -1.0, 0.0, 1.0), PowellSingular{}), 0.0,
                      {Vector4d(0.0, 0.0, 0.0, 0.0)}));
  all.push_back(known("extended_rosenbrock", "MGH 21 with six unknowns",
                      least_squares<6>(six(-1.2, 1.0, -1.2, 1.0, -1.2, 1.0), ExtendedRosenbrock{}),
                      0.0, {six(1.0, 1.0, 1.0, 1.0, 1.0, 1.0)}));
}

void add_bounded(std::vector<KnownProblem>& all) {
  all.push_back(with_higher_minima(
      known("mccormick", "McCormick 1976; HS 5",
            bounded(Problem(Vector2d(0.0, 0.0), differentiated<2>(McCormick{})),
                    Vector2d(-1.5, -3.0), Vector2d(4.0, 3.0)),
            -std::sqrt(3.0) / 2.0 - pi / 3.0, {Vector2d(0.5 - pi / 3.0, -0.5 - pi / 3.0)})));
  all.push_back(known("branin", "Branin 1972; the start is ours",
                      bounded(Problem(Vector2d(2.0, 5.0), differentiated<2>(Branin{})),
                              Vector2d(-5.0, 0.0), Vector2d(10.0, 15.0)),
                      10.0 / (8.0 * pi),
                      {Vector2d(-pi, 12.275), Vector2d(pi, 2.275), Vector2d(3.0 * pi, 2.475)}));
  all.push_back(with_higher_minima(
      known("six_hump_camel", "Dixon, Szego 1978; the start is ours",
            bounded(Problem(Vector2d(0.5, -0.5), differentiated<2>(SixHumpCamel{})),
                    Vector2d(-3.0, -2.0), Vector2d(3.0, 2.0)),
            -1.0316284534898774,
            {Vector2d(0.089842013100318058, -0.71265640302073963),
             Vector2d(-0.089842013100318058, 0.71265640302073963)})));
  all.push_back(with_higher_minima(
      known("rosenbrock_on_a_bound", "HS 2; the start is ours, as theirs is out of bounds",
            bounded(Problem(Vector2d(2.0, 2.0), differentiated<2>(Rosenbrock{})),
                    Vector2d(-infinity, 1.5), Vector2d(infinity, infinity)),
            0.050426187893607075, {Vector2d(1.2243707487363524, 1.5)})));
  all.push_back(
      known("hock_schittkowski_4", "HS 4: a corner of the bounds",
            bounded(Problem(Vector2d(1.125, 0.125), differentiated<2>(HockSchittkowski4{})),
                    Vector2d(1.0, 0.0), Vector2d(infinity, infinity)),
            8.0 / 3.0, {Vector2d(1.0, 0.0)}));
  all.push_back(with_higher_minima(
      known("chain_with_a_fixed_end", "ours: Rosenbrock's valley twice, the last unknown fixed",
            bounded(Problem(Vector3d(1.5, 1.0, 0.5), differentiated<3>(RosenbrockChain{})),
                    Vector3d(-5.0, -5.0, 0.5), Vector3d(5.0, 5.0, 0.5)),
            0.1102692974006623, {Vector3d(0.8425882987219756, 0.70902094496884094, 0.5)})));
}

void add_constrained(std::vector<KnownProblem>& all) {
  // On the parabola, 2 x^3 + x = 5.
  const double x = 1.234772825053297;
  all.push_back(
      known("hock_schittkowski_11", "HS 11; the start is not feasible",
            constrained<2>(Problem(Vector2d(4.9, 0.1), differentiated<2>(HockSchittkowski11{})),
                           AboveAParabola{}),
            (x - 5.0) * (x - 5.0) + x * x * x * x - 25.0, {Vector2d(x, x * x)}));
  all.push_back(known(
      "hock_schittkowski_24", "HS 24: a vertex",
      bounded(constrained<2>(Problem(Vector2d(1.0, 0.5), differentiated<2>(HockSchittkowski24{})),
                             ATriangle{}),
              Vector2d(0.0, 0.0), Vector2d(infinity, infinity)),
      -1.0, {Vector2d(3.0, std::sqrt(3.0))}));
  const double y = 2.0 * std::sqrt(2.0);
  all.push_back(known(
      "hock_schittkowski_29", "HS 29",
      constrained<3>(Problem(Vector3d(1.0, 1.0, 1.0), differentiated<3>(HockSchittkowski29{})),
                     AnEllipsoid{}),
      -16.0 * std::sqrt(2.0),
      {Vector3d(4.0, y, 2.0), Vector3d(4.0, -y, -2.0), Vector3d(-4.0, y, -2.0),
       Vector3d(-4.0, -y, 2.0)}));
  all.push_back(known("hock_schittkowski_35", "Beale 1967; HS 35: quadratic",
                      bounded(constrained<3>(Problem(Vector3d(0.5, 0.5, 0.5),
                                                     differentiated<3>(HockSchittkowski35{})),
                                             BelowAPlane{}),
                              Vector3d(0.0, 0.0, 0.0), Vector3d(infinity, infinity, infinity)),
                      1.0 / 9.0, {Vector3d(4.0 / 3.0, 7.0 / 9.0, 4.0 / 9.0)}));
  all.push_back(
      known("rosen_suzuki", "Rosen, Suzuki 1965; HS 43",
            constrained<4>(Problem(Vector4d(0.0, 0.0, 0.0, 0.0), differentiated<4>(RosenSuzuki{})),
                           RosenSuzukiConstraints{}),
            -44.0, {Vector4d(0.0, 1.0, 2.0, -1.0)}));
  // The place lies 50 m from the obstacle, in the direction (0.6, 0.8); 100 m are to be kept.
  all.push_back(
      known("place_beside_an_obstacle", "ours: as near to a place as an obstacle allows",
            constrained<2>(least_squares<2>(Vector2d(150.0, 0.0), ToAPlace{}), ClearOfAnObstacle{}),
            2500.0, {Vector2d(70.0, 100.0)}));
}

void add_formation(std::vector<KnownProblem>& all) {
  const AttractionRepulsion<2> two{{{{-280, -81}, {-25, -193}}}};
  // The same on either side of the line through the two; the thesis takes the nearer one.
  all.push_back(known("two_neighbours", "Rypkema 2015, fig. 3.7",
                      Problem(Vector2d(0.0, 0.0), differentiated<2>(two)), -899.2948204065758,
                      {Vector2d(-45.779520557433607, 105.97966301655737),
                       Vector2d(-259.2204794425664, -379.97966301655737)}));
  const AttractionRepulsion<5> five{
      {{{-310, -20}, {15, 290}, {-290, 280}, {305, -10}, {-20, -300}}}};
  all.push_back(with_higher_minima(known(
      "five_neighbours", "Rypkema 2015, eq. 3.7 with five neighbours, the start in the middle",
      Problem(Vector2d(40.0, -60.0), differentiated<2>(five)), -2220.2967234801081,
      {Vector2d(-24.198231370999977, 12.960730766659436)})));

  const auto places = differentiated_blocks<2>(ImpliedPlaces{});
  const Vector2d mean(39.0, -79.0 / 3.0);
  all.push_back(known("placement_huber", "ours: a point among places and an outlier",
                      least_squares_problem(mean, {places, loss("huber", 10.0), {}}),
                      5808.0309235580935, {Vector2d(5.5484287217398309, -1.6865441434066115)}));
  all.push_back(with_higher_minima(
      known("placement_cauchy", "ours: the same with another loss",
            least_squares_problem(mean, {places, loss("cauchy", 10.0), {}}), 1027.1896419363693,
            {Vector2d(4.3044363881433849, 0.17772940825424816)})));

  const std::vector<double> weights{0.5, 1.0, 1.0, 1.0, 1.0};
  all.push_back(known(
      "registration", "Rypkema 2015, eq. 3.8 in (radius times angle, east, north)",
      least_squares_problem(Vector3d(0.0, 0.0, 0.0),
                            {differentiated_blocks<3>(RigidRegistration{}), nullptr, weights}),
      159.24246061086586, {Vector3d(129.66252314410758, 119.35697130336916, -44.396615221506813)}));
  RigidRegistration mistaken;
  mistaken.seen[3] = {563.1, -53.3};
  all.push_back(known(
      "registration_huber", "ours: the same with one slot taken for another",
      least_squares_problem(Vector3d(0.0, 0.0, 0.0),
                            {differentiated_blocks<3>(mistaken), loss("huber", 30.0), weights}),
      29190.207682311062, {Vector3d(126.3233594290174, 122.73138415974782, -47.349307970266238)}));
}

}  // namespace

std::vector<KnownProblem> known_problems() {
  std::vector<KnownProblem> all;
  add_smooth(all);
  add_least_squares(all);
  add_bounded(all);
  add_constrained(all);
  add_formation(all);
  return all;
}

std::vector<std::string> names_of_known_problems() {
  std::vector<std::string> names;
  for (const KnownProblem& known : known_problems()) names.push_back(known.name);
  return names;
}

KnownProblem known_problem(const std::string& name) {
  for (const KnownProblem& known : known_problems()) {
    if (known.name == name) return known;
  }
  throw std::invalid_argument("no known problem is called \"" + name + '"');
}

Problem boxed(const KnownProblem& known) {
  Problem problem = known.problem;
  Vector low = problem.start, high = problem.start;
  for (const Vector& x : known.minimisers) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double around = 0.5 * std::max(1.0, (high - low).maxCoeff());
  low.array() -= around;
  high.array() += around;
  for (int i = 0; i < problem.dimension() && problem.lower; ++i) {
    if (std::isfinite((*problem.lower)[i])) low[i] = (*problem.lower)[i];
    if (std::isfinite((*problem.upper)[i])) high[i] = (*problem.upper)[i];
  }
  problem.lower = low;
  problem.upper = high;
  return problem;
}

}  // namespace shoal::solvers::tests
