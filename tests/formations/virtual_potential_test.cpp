#include "shoal/formations/fields/virtual_potential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shoal/core/registry.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/formations/obstacles/shapes.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/reference_table.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

const double e = std::exp(1.0);

/// A contour by any of its three names, at one distance.
template <class Contour>
void expect_derivatives(const Contour& contour, double d) {
  const double h = 1e-5 * std::max(1.0, d);
  const RadialValue here = contour.at(d), less = contour.at(d - h), more = contour.at(d + h);
  const double slope_size = std::abs(here.slope) + std::abs(here.value) * 1e-5 + 1e-12;
  EXPECT_NEAR((more.value - less.value) / (2 * h), here.slope, 1e-6 * slope_size) << d;
  EXPECT_NEAR((more.slope - less.slope) / (2 * h), here.curvature,
              1e-6 * (std::abs(here.curvature) + slope_size))
      << d;
}

TEST(ObstacleContour, IsThatOfEquation6) {
  const ObstacleContour contour{.reach_m = 18.0, .strength_m2_s2 = 2.0};
  EXPECT_NEAR(contour.at(18).value, 2.0 * (e - 1.0), 1e-14);
  EXPECT_NEAR(contour.at(18).slope, -2.0 * e / 18.0, 1e-15);
  EXPECT_NEAR(contour.push(9), 2.0 * 18.0 / 81.0 * e * e, 1e-13);
  EXPECT_EQ(contour.push(9), -contour.at(9).slope);
  for (const double d : {0.7, 1.0, 5.0, 18.0, 100.0, 1e4}) expect_derivatives(contour, d);
  // Far away A/d^2 remains of it, without the rounding of exp(A/d) - 1.
  EXPECT_NEAR(contour.at(1e9).value / (2.0 * 18e-9), 1.0, 1e-7);
}

TEST(ObstacleContour, PushesOutAsHardInsideAsAtItsNearest) {
  const ObstacleContour contour{.reach_m = 18.0};
  EXPECT_EQ(contour.nearest_m(), 0.6);
  EXPECT_EQ((ObstacleContour{.reach_m = 6.0}.nearest_m()), 0.5);
  EXPECT_NEAR(contour.push(0.6) / (18.0 / 0.36 * std::exp(30.0)), 1.0, 1e-14);
  for (const double d : {0.59, 0.0, -3.0, -1e3}) {
    EXPECT_EQ(contour.push(d), contour.push(0.6));
    EXPECT_EQ(contour.at(d).slope, contour.at(0.6).slope);
    expect_derivatives(contour, d);
  }
  EXPECT_NEAR(contour.at(0.6 - 1e-9).value / contour.at(0.6).value, 1.0, 1e-6);
}

TEST(WaypointContour, IsThatOfEquation8WithTheLesserSlope) {
  const WaypointContour contour{.pull_m_s2 = 0.06, .near_m = 60.0};  // A_p = 0.001
  EXPECT_EQ(contour.at(0).value, 0.0);
  EXPECT_EQ(contour.at(0).slope, 0.0);
  EXPECT_NEAR(contour.at(30).slope, 0.03, 1e-16);
  EXPECT_NEAR(contour.at(60).value, 0.06 * 0.06 / (2 * 0.001), 1e-15);  // p_0, eq. 9
  EXPECT_NEAR(contour.at(1000).slope, 0.06, 1e-16);
  EXPECT_NEAR(contour.at(1000).value, 0.06 * 1000 - 1.8, 1e-13);
  for (const double d : {1.0, 30.0, 59.0, 61.0, 500.0}) expect_derivatives(contour, d);
}

TEST(VertexContour, PullsHardestAtItsWidthAndThenWithItsGain) {
  const VertexContour contour{.pull_m_s2 = 0.05, .width_m = 10.0};
  EXPECT_NEAR(contour.at(10).slope, 0.05, 1e-17);  // eq. 16
  EXPECT_NEAR(contour.at(10).curvature, 0.0, 1e-17);
  EXPECT_NEAR(contour.at(0).value, -0.5 * std::sqrt(e), 1e-15);  // C8
  EXPECT_EQ(contour.at(0).slope, 0.0);
  EXPECT_NEAR(contour.at(200).value, 0.0, 1e-80);
  for (const double d : {9.0, 9.9, 10.1, 11.0}) EXPECT_LT(contour.at(d).slope, 0.05);
  for (const double d : {0.1, 5.0, 10.0, 30.0}) expect_derivatives(contour, d);
}

std::shared_ptr<const Obstacle> shared(auto shape) {
  return std::make_shared<const decltype(shape)>(shape);
}

/// A waypoint behind an ellipse and a rectangle, and two other agents.
struct Sea {
  Vector2d waypoint{100, 10};
  std::vector<std::shared_ptr<const Obstacle>> obstacles{shared(Ellipse({40, 0}, 15, 6, 0.4)),
                                                         shared(Rectangle({10, 60}, 20, 5, -0.2))};
  VirtualPotential potential = made({});
  std::vector<Agent> others{{{-40, 5}, 0.3}, {{-20, -30}, 2.0}};

  VirtualPotential made(const VirtualPotentialGains& gains) const {
    return {gains, waypoint, obstacles};
  }
};

std::vector<Vector2d> places_at_sea() {
  std::vector<Vector2d> all;
  for (int i = 0; i < 60; ++i) {
    const Vector2d place(-70.0 + 37.0 * (i % 5) + 0.3 * i, -60.0 + 13.0 * (i % 11) - 0.2 * i);
    all.push_back(place);
  }
  return all;
}

TEST(VirtualPotential, HasTheDerivativesOfItsValue) {
  for (const auto axes : {FormationCell::Axes::fixed, FormationCell::Axes::heading}) {
    Sea sea;
    VirtualPotentialGains gains;
    gains.cell.axes = axes;
    const VirtualPotential potential = sea.made(gains);
    int checked = 0;
    for (const Vector2d& place : places_at_sea()) {
      const PlaneValue exact = potential.potential(place, sea.others);
      if (exact.gradient.norm() > 1e3) continue;  // inside, where differences are all rounding
      ++checked;
      const double size = 1.0 + exact.gradient.norm() + exact.hessian.norm();
      for (int i = 0; i < 2; ++i) {
        constexpr double h = 1e-5;
        const Vector2d step = h * Vector2d::Unit(i);
        const PlaneValue more = potential.potential(place + step, sea.others);
        const PlaneValue less = potential.potential(place - step, sea.others);
        EXPECT_NEAR((more.value - less.value) / (2 * h), exact.gradient[i], 1e-6 * size) << place;
        const Vector2d bend = (more.gradient - less.gradient) / (2 * h);
        EXPECT_LT((bend - exact.hessian.col(i)).norm(), 1e-6 * size) << place;
      }
    }
    EXPECT_GT(checked, 40);
  }
}

TEST(VirtualPotential, TurnsWithTheWorld) {
  const Transform2 T = Transform2::from_angle(1.1, {-300, 70});
  VirtualPotentialGains gains;
  gains.cell.axes = FormationCell::Axes::heading;
  const auto ellipse = shared(Ellipse({40, 0}, 15, 6, 0.4));
  const auto ellipse_turned = shared(Ellipse(T * Vector2d(40, 0), 15, 6, 0.4 + 1.1));
  const VirtualPotential here(gains, {100, 10}, {&ellipse, 1});
  const VirtualPotential there(gains, T * Vector2d(100, 10), {&ellipse_turned, 1});
  const std::vector<Agent> others{{{-40, 5}, 0.3}};
  const std::vector<Agent> turned{{T * others[0].position, 0.3 + 1.1}};
  const Vector2d velocity(1.0, -0.2);
  for (const Vector2d& place : places_at_sea()) {
    const Vector2d force = here.force(place, velocity, others);
    const Vector2d same = there.force(T * place, T.rotate(velocity), turned);
    EXPECT_LT((T.rotate(force) - same).norm(), 1e-9 * (1.0 + force.norm())) << place;
  }
}

TEST(VirtualPotential, ForcesAreTheNegativeGradientTheRotorAndTheDamping) {
  const Sea sea;
  const Vector2d velocity(1.4, 0.0);
  for (const Vector2d& place : places_at_sea()) {
    const Vector2d expected = -sea.potential.potential(place, sea.others).gradient +
                              sea.potential.rotor(place, velocity) - Vector2d(0.05, 0.0);
    EXPECT_LT((sea.potential.force(place, velocity, sea.others) - expected).norm(),
              1e-15 * (1.0 + expected.norm()));
  }
  // Far from everything, the terminal speed of the plateau is that of the cruise (C12).
  const VirtualPotential open({}, {1e6, 0}, {});
  EXPECT_LT(open.force({0, 0}, velocity, {}).norm(), 1e-16);
}

TEST(VirtualPotential, IsFlatAtAWaypointAndAtAVertex) {
  const VirtualPotential open({}, {3, 4}, {});
  const PlaneValue at = open.potential({3, 4}, {});
  EXPECT_EQ(at.gradient, Vector2d(0, 0));
  EXPECT_NEAR((at.hessian - 0.05 / 60 * Eigen::Matrix2d::Identity()).norm(), 0.0, 1e-18);

  VirtualPotentialGains vertices_only;
  vertices_only.waypoint.pull_m_s2 = 0.0;
  vertices_only.cell.agent.strength_m2_s2 = 0.0;
  vertices_only.cell.side_m = 300.0;
  const std::vector<Agent> other{{{0, 0}, 0.0}};
  const PlaneValue vertex = VirtualPotential(vertices_only, {0, 0}, {}).potential({300, 0}, other);
  EXPECT_LT(vertex.gradient.norm(), 1e-100);
  EXPECT_NEAR(vertex.hessian(0, 0), 0.05 / 10 * std::sqrt(e), 1e-17);
}

TEST(FormationCell, HasItsVerticesOnTheAxesOrTurnsThemWithTheAgent) {
  FormationCell cell;
  const Agent middle{{100, 50}, pi / 6};
  EXPECT_EQ(cell.vertices(middle)[0], Vector2d(130, 50));
  EXPECT_EQ(cell.vertices(middle)[1], Vector2d(100, 80));
  EXPECT_EQ(cell.vertices(middle)[2], Vector2d(70, 50));
  EXPECT_EQ(cell.vertices(middle)[3], Vector2d(100, 20));
  cell.axes = FormationCell::Axes::heading;
  const auto vertices = cell.vertices(middle);
  for (int k = 0; k < 4; ++k) {
    const double angle = pi / 6 + k * pi / 2;
    const Vector2d expected = Vector2d(100, 50) + 30.0 * Vector2d(std::cos(angle), std::sin(angle));
    EXPECT_LT((vertices[static_cast<std::size_t>(k)] - expected).norm(), 1e-13);
  }
}

TEST(FormationCell, MasksAVertexThatIsTaken) {
  // Seen from the third vehicle, the vertex of the first is where the second is.
  const VirtualPotential open({}, {0, 0}, {});
  const std::vector<Agent> alone{{{0, 0}, 0.0}};
  const std::vector<Agent> taken{{{0, 0}, 0.0}, {{30, 0}, 0.0}};
  const auto pull_towards_vertex = [&](const std::vector<Agent>& others) {
    return open.force({30, 8}, {0, 0}, others).y() - open.force({30, 8}, {0, 0}, {}).y();
  };
  EXPECT_LT(pull_towards_vertex(alone), -0.04);
  EXPECT_GT(pull_towards_vertex(taken), 0.2);
}

TEST(FormationCell, HoldsASquareOfFourVehicles) {
  // By symmetry each corner is pushed along the diagonal only, and in less than it would be off it.
  VirtualPotentialGains gains;
  gains.waypoint.pull_m_s2 = 0.0;
  const VirtualPotential open(gains, {0, 0}, {});
  const std::vector<Agent> others{{{-15, 15}, 0.0}, {{15, -15}, 0.0}, {{-15, -15}, 0.0}};
  const Vector2d force = open.force({15, 15}, {0, 0}, others);
  EXPECT_NEAR(force.x(), force.y(), 1e-15);
  EXPECT_LT(open.force({20, 20}, {0, 0}, others).x(), 0.0);
  EXPECT_GT(open.force({10, 10}, {0, 0}, others).x(), 0.0);
}

// x_i = 0, w = (10, 0), x = (-5, -1): C13.
TEST(Rotor, LeadsRoundTheNearerSideOfAnObstacleBeforeTheWaypoint) {
  const Circle circle({0, 0}, 1);
  const Vector2d place(-5, -1), waypoint(10, 0);
  const Rotor rotor;
  const Proximity near = circle.nearest(place);
  const Rotor::Turn turn = rotor.turn(near.normal, circle.centre(), waypoint, {0, 0});
  EXPECT_NEAR(turn.alignment, 5.0 / std::sqrt(26.0), 1e-15);
  const Vector2d force = rotor.force(near, turn);
  EXPECT_LT((force.normalized() - Vector2d(1, -5) / std::sqrt(26.0)).norm(), 1e-14);
  EXPECT_NEAR(force.norm(), rotor.contour.push(near.distance), 1e-12 * force.norm());
  EXPECT_EQ(rotor.turn({5, 1}, {0, 0}, waypoint, {0, 0}).sense, 0);  // passed
}

TEST(Rotor, KeepsTheWayItAlreadyTurnsExactlyBehindTheObstacle) {
  const Rotor rotor;
  const Vector2d behind(-1, 0), waypoint(10, 0);
  const auto sense = [&](const Vector2d& velocity) {
    return rotor.turn(behind, {0, 0}, waypoint, velocity).sense;
  };
  EXPECT_EQ(sense({1, 0.1}), -1);
  EXPECT_EQ(sense({1, -0.1}), 1);
  EXPECT_EQ(sense({1, 0}), 1);
  EXPECT_EQ(sense({0, 0}), 1);
  // Within the tie of 1e-3 the velocity decides, outside of it the nearer side.
  const auto at_alignment = [&](double r) { return Vector2d(-r, std::sqrt(1 - r * r)); };
  const auto faced = [&](double r) {
    return rotor.turn(at_alignment(r), {0, 0}, waypoint, {0, -1}).sense;
  };
  EXPECT_EQ(faced(0.9995), 1);
  EXPECT_EQ(faced(0.9985), -1);
}

TEST(Rotor, NeverTurnsBackFromTheWaypoint) {
  const Rotor rotor;
  const Circle circle({3, 4}, 5);
  const Vector2d waypoint(60, -20);
  for (int i = 0; i < 360; ++i) {
    const Vector2d place =
        circle.centre() + 9.0 * Vector2d(std::cos(0.0175 * i), std::sin(0.0175 * i));
    const Proximity near = circle.nearest(place);
    const auto turn = rotor.turn(near.normal, circle.centre(), waypoint, {0, 0});
    const Vector2d force = rotor.force(near, turn);
    EXPECT_NEAR(force.dot(near.normal), 0.0, 1e-12 * (1 + force.norm()));
    if (turn.alignment < 1.0 - rotor.tie) {
      EXPECT_GE(force.dot(waypoint - circle.centre()), 0.0);
    }
    EXPECT_EQ(turn.sense != 0, turn.alignment >= 0.0);
  }
}

TEST(Rotor, FadesWhereTheObstacleIsPassedIfItIsTapered) {
  const Rotor jumping, fading{.taper = 0.2};
  const Circle circle({0, 0}, 5);
  const Proximity near = circle.nearest({0, 10});
  const double full = jumping.contour.push(5.0);
  const auto size = [&](const Rotor& rotor, double alignment) {
    return rotor.force(near, {alignment, 1}).norm();
  };
  for (const double r : {0.0, 0.05, 0.1, 0.2, 0.9}) {
    EXPECT_NEAR(size(jumping, r), full, 1e-12 * full);
    EXPECT_NEAR(size(fading, r), full * std::min(1.0, r / 0.2), 1e-12 * full);
  }
}

TEST(Rotor, IsNothingForAnObstacleAroundTheWaypoint) {
  const auto turn = Rotor{}.turn({1, 0}, {7, 8}, {7, 8}, {1, 1});
  EXPECT_EQ(turn.sense, 0);
  EXPECT_EQ(turn.alignment, 0.0);
}

TEST(VirtualPotentialReference, AgreesWithAnotherImplementation) {
  const shoal::tests::ReferenceTable table("potential_field.csv", {"kind",
                                                                   "cx",
                                                                   "cy",
                                                                   "a",
                                                                   "b",
                                                                   "psi",
                                                                   "x",
                                                                   "y",
                                                                   "vx",
                                                                   "vy",
                                                                   "wx",
                                                                   "wy",
                                                                   "d",
                                                                   "nx",
                                                                   "ny",
                                                                   "stator_x",
                                                                   "stator_y",
                                                                   "r_i",
                                                                   "sigma",
                                                                   "rotor_x",
                                                                   "rotor_y",
                                                                   "wp_x",
                                                                   "wp_y",
                                                                   "vertex_at_cxcy_x",
                                                                   "vertex_at_cxcy_y"});
  ASSERT_EQ(table.rows(), 20u);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto pair = [&](const std::string& x, const std::string& y) {
      return Vector2d(table.number(row, x), table.number(row, y));
    };
    const Vector2d centre = pair("cx", "cy"), place = pair("x", "y"), w = pair("wx", "wy");
    const Vector2d velocity = pair("vx", "vy"), size = pair("a", "b");
    const bool circle = table.text(row, "kind") == "circle";
    std::shared_ptr<const Obstacle> obstacle =
        circle ? shared(Circle(centre, size.x()))
               : shared(Rectangle(centre, size.x(), size.y(), table.number(row, "psi")));

    // Each term by itself: the others are switched off.
    VirtualPotentialGains gains;
    const VirtualPotential waypoint_only(gains, w, {});
    gains.waypoint.pull_m_s2 = 0.0;
    const VirtualPotential obstacle_only(gains, w, {&obstacle, 1});
    const auto close = [&](const Vector2d& got, const std::string& name) {
      const Vector2d expected = pair(name + "_x", name + "_y");
      EXPECT_LT((got - expected).norm(), 1e-9) << table.line(row) << name;
    };
    close(-waypoint_only.potential(place, {}).gradient, "wp");
    close(-obstacle_only.potential(place, {}).gradient, "stator");
    close(obstacle_only.rotor(place, velocity), "rotor");
    const Vector2d from_vertex = place - centre;
    close(-of_displacement(gains.cell.vertex.at(from_vertex.norm()), from_vertex).gradient,
          "vertex_at_cxcy");

    const Proximity near = obstacle->nearest(place);
    const Rotor::Turn turn = gains.rotor.turn(near.normal, centre, w, velocity);
    EXPECT_NEAR(turn.alignment, table.number(row, "r_i"), 1e-9) << table.line(row);
    EXPECT_EQ(turn.sense, table.number(row, "sigma")) << table.line(row);
  }
}

TEST(VirtualPotentialCost, LeadsSolversToAVertexOfTheCell) {
  VirtualPotentialGains gains;
  gains.waypoint.pull_m_s2 = 0.0;
  gains.cell.agent.strength_m2_s2 = 0.0;
  const VirtualPotential open(gains, {0, 0}, {});
  const std::vector<Agent> others{{{500, 200}, 0.0}};
  const Vector2d origin(535, 203);
  const solvers::Problem problem(Vector2d::Zero(), VirtualPotentialCost(open, origin, others));
  for (const char* kind : {"newton", "nlopt.lbfgs"}) {
    const auto solver = Registry<solvers::Solver>::instance().make(kind, Setting{}, "test");
    const solvers::Solution solution = solver->solve(problem);
    ASSERT_EQ(solution.status, solvers::Status::converged) << kind;
    // The three other vertices pull a little, as exp(-30^2 / (2 10^2)).
    EXPECT_LT((origin + solution.x.head<2>() - Vector2d(530, 200)).norm(), 0.5) << kind;
    EXPECT_LT(open.potential(origin + solution.x.head<2>(), others).gradient.norm(), 1e-8) << kind;
  }
}

TEST(VirtualPotentialCost, MayBeKeptWhenWhatItWasMadeOfHasGone) {
  std::optional<solvers::Problem> kept;
  double there = 0.0;
  const double x[2] = {3.0, -4.0};
  {
    const auto potential =
        std::make_unique<VirtualPotential>(VirtualPotentialGains{}, Vector2d(300, 0), Obstacles{});
    auto others = std::make_unique<std::vector<Agent>>(5, Agent{{20, 35}, 0.2});
    kept.emplace(Vector2d::Zero(), VirtualPotentialCost(*potential, {7, 9}, *others));
    there = kept->evaluate(x);
    std::ranges::fill(*others, Agent{{-1e3, 0}, 0.0});
  }
  EXPECT_EQ(kept->evaluate(x), there);
}

TEST(VirtualPotential, DoesNotAllocate) {
  const Sea sea;
  Vector2d sum = Vector2d::Zero();
  const std::size_t before = shoal::tests::heap_requests();
  for (const Vector2d& place : {Vector2d(0, 0), Vector2d(41, 1), Vector2d(-40, 5)}) {
    sum += sea.potential.force(place, {1, 0}, sea.others);
  }
  EXPECT_EQ(shoal::tests::heap_requests(), before);
  EXPECT_TRUE(sum.allFinite());
}

}  // namespace
}  // namespace shoal::formations
