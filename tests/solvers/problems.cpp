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
#include "shoal/solvers/matching/points.hpp"
#include "tests/solvers/problem_costs.hpp"

namespace shoal::solvers::tests {
namespace {

using namespace costs;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Vector = Problem::Vector;
using Vector1d = Eigen::Matrix<double, 1, 1>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using std::numbers::pi;
// How they are posed ----------------------------------------------------------------------------

template <int N, class Residuals>
Problem least_squares(const Vector& start, const Residuals& residuals) {
  return least_squares_problem(start, {differentiated_blocks<N>(residuals), nullptr, {}});
}

std::shared_ptr<const Loss> shared_loss(const std::string& kind, double scale_m) {
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

template <int N, class Equalities>
Problem equal(Problem problem, const Equalities& equalities) {
  problem.equalities = differentiated_blocks<N>(equalities);
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
  all.push_back(known(
      "hock_schittkowski_6", "HS 6: an equality",
      equal<2>(Problem(Vector2d(-1.2, 1.0), differentiated<2>(HockSchittkowski6{})), OnAParabola{}),
      0.0, {Vector2d(1.0, 1.0)}));
  all.push_back(
      known("hock_schittkowski_28", "HS 28: a linear equality",
            equal<3>(Problem(Vector3d(-4.0, 1.0, 1.0), differentiated<3>(HockSchittkowski28{})),
                     OnAPlane{}),
            0.0, {Vector3d(0.5, -0.5, 0.5)}));
  const double a = std::pow(2.0, -1.0 / 3.0), b = std::sqrt(0.5);
  const double c = std::pow(2.0, -11.0 / 12.0), d = std::pow(2.0, -0.25);
  all.push_back(
      known("hock_schittkowski_40", "HS 40: three equalities",
            equal<4>(Problem(Vector4d(0.8, 0.8, 0.8, 0.8), differentiated<4>(HockSchittkowski40{})),
                     ThreeEqualities{}),
            -0.25, {Vector4d(a, b, c, d), Vector4d(a, b, -c, -d)}));
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
                      least_squares_problem(mean, {places, shared_loss("huber", 10.0), {}}),
                      5808.0309235580935, {Vector2d(5.5484287217398309, -1.6865441434066115)}));
  all.push_back(with_higher_minima(
      known("placement_cauchy", "ours: the same with another loss",
            least_squares_problem(mean, {places, shared_loss("cauchy", 10.0), {}}),
            1027.1896419363693, {Vector2d(4.3044363881433849, 0.17772940825424816)})));

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
      least_squares_problem(Vector3d(0.0, 0.0, 0.0), {differentiated_blocks<3>(mistaken),
                                                      shared_loss("huber", 30.0), weights}),
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
