#include <gtest/gtest.h>

#include "shoal/formations/cohesion.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"
#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/formations/swarm.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const char* const attraction_kind = "attraction_repulsion";

/// The cost of eq. 3.7 for the two selected neighbours and the centroid given.
double cost(const Vector2d& p, const Neighbours& selected, const Vector2d& centroid,
            double share = 1.0) {
  double sum = 1e-5 * (p - centroid).squaredNorm();
  for (const Neighbour& n : selected) {
    const double r = (p - n.position).norm();
    sum += share * (300.0 * 300.0 * 300.0 / (2.0 * r * r) + r - 900.0);
  }
  return sum;
}

// The example of fig. 3.7: the nearer of the two points at 300 m from both neighbours, and where
// the pull of the centroid moves it. The thesis prints (-45, 106).
const Neighbours figure37 = neighbours_at({{-280, -81}, {-25, -193}});
const Vector2d equidistant37(-45.6437, 106.2889);
const Vector2d answer37(-45.7795, 105.9797);

/// Smooth and without anything special, to ask solvers what they can do.
struct Bowl {
  template <class T>
  T operator()(const T* x) const {
    return x[0] * x[0] + x[1] * x[1];
  }
};

// Every solver ---------------------------------------------------------------------------------

class EverySolver : public testing::TestWithParam<std::string> {};

TEST_P(EverySolver, FindsThePlaceOfFigure37) {
  const auto solver = Registry<solvers::Solver>::instance().make(GetParam(), Setting{}, "test");
  if (const auto why = solver->refuses({Vector2d(0, 0), solvers::differentiated<2>(Bowl{})})) {
    GTEST_SKIP() << GetParam() << " " << *why;
  }
  const auto target = [&](double centroid_weight) {
    return behaviour(attraction_kind,
                     {{"cohesion.centroid.weight", centroid_weight}, {"solver.kind", GetParam()}})
        ->step({figure37, 0}, unused_plan);
  };
  EXPECT_EQ(target(0.0).reason, Reason::placed);
  EXPECT_LT((target(0.0).position - equidistant37).norm(), 1e-3);
  EXPECT_NEAR(target(0.0).cost, -900.0, 1e-6);  // twice -1.5 s
  EXPECT_LT((target(1e-5).position - answer37).norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver,
                         testing::ValuesIn(Registry<solvers::Solver>::instance().names()),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

// The choice of neighbours, and the centroid ----------------------------------------------------

TEST(AttractionRepulsion, ChoosesTheNearestAndTheOneOfTheShortestTriangle) {
  // The second nearest (310 m, but opposite) makes a longer triangle than the third.
  const Neighbours seen = neighbours_at({{-310, 0}, {250, 0}, {200, 280}});
  const auto without_centroid = behaviour(attraction_kind, {{"cohesion.centroid.weight", 0.0}});
  const Vector2d target = without_centroid->step({seen, 0}, unused_plan).position;
  EXPECT_NEAR((target - seen[1].position).norm(), 300.0, 0.01);
  EXPECT_NEAR((target - seen[2].position).norm(), 300.0, 0.01);
}

TEST(AttractionRepulsion, IgnoresNeighboursOutOfRange) {
  const auto near_only = behaviour(attraction_kind, {{"contact_rangeout_m", 300.0}});
  const auto all_near =
      near_only->step({neighbours_at({{-200, -81}, {-25, -193}}), 0}, unused_plan);
  const auto with_far =
      near_only->step({neighbours_at({{0, 301}, {-200, -81}, {-25, -193}}), 0}, unused_plan);
  EXPECT_EQ(all_near.position, with_far.position);
  EXPECT_EQ(near_only->step({neighbours_at({{0, 301}}), 0}, unused_plan).reason,
            Reason::no_neighbour);
}

TEST(AttractionRepulsion, MinimisesTheSumAndThePullOfTheCentroidOfAllNeighbours) {
  const Neighbours seen = neighbours_at({{-280, -81}, {-25, -193}, {600, 150}});
  const Vector2d centroid = (seen[0].position + seen[1].position + seen[2].position) / 3.0;
  const Target target = behaviour(attraction_kind)->step({seen, 0}, unused_plan);
  const auto expected = [&](const Vector2d& p) { return cost(p, figure37, centroid); };
  EXPECT_NEAR(target.cost, expected(target.position), 1e-9);
  for (int i = 0; i < 12; ++i) {  // lower than anywhere around
    const Vector2d step = 0.05 * Vector2d(std::cos(0.5236 * i), std::sin(0.5236 * i));
    EXPECT_LT(target.cost, expected(target.position + step));
  }
  EXPECT_GT((target.position - answer37).norm(), 0.1);  // it is drawn away by the third
}

// The author's program: the mean of the potentials, and the own position in the centroid.
TEST(AttractionRepulsion, MinimisesTheMeanWithTheOwnPositionInTheCentroidInTheAuthorsVariant) {
  // The third is in range, and in the centroid, but not selected.
  const Neighbours seen = neighbours_at({{-280, -81}, {-25, -193}, {600, 150}});
  const Vector2d centroid = (seen[0].position + seen[1].position + seen[2].position) / 4.0;
  const Target target =
      behaviour(attraction_kind, {{"combination", "mean"}, {"cohesion.centroid.counts_own", true}})
          ->step({seen, 0}, unused_plan);
  const auto expected = [&](const Vector2d& p) { return cost(p, figure37, centroid, 0.5); };
  EXPECT_NEAR(target.cost, expected(target.position), 1e-9);
  for (int i = 0; i < 12; ++i) {
    const Vector2d step = 0.05 * Vector2d(std::cos(0.5236 * i), std::sin(0.5236 * i));
    EXPECT_LT(target.cost, expected(target.position + step));
  }
}

// One neighbour at 200 m: f'(r) = share * (1 - (s/r)^3) + 2 w (r - distance to the centroid).
TEST(AttractionRepulsion, KeepsTheSeparationFromASingleNeighbour) {
  const Target free = behaviour(attraction_kind, {{"cohesion.centroid.weight", 0.0}})
                          ->step({neighbours_at({{0, 200}}), 0}, unused_plan);
  EXPECT_LT((free.position - Vector2d(0, -100)).norm(), 0.01);
}

TEST(AttractionRepulsion, TakesTheSeparationFromItsOptions) {
  const Target target =
      behaviour(attraction_kind, {{"cohesion.centroid.weight", 0.0}, {"separation_m", 60.0}})
          ->step({neighbours_at({{100, 0}}), 0}, unused_plan);
  EXPECT_LT((target.position - Vector2d(40, 0)).norm(), 0.01);
}

// Invariance ------------------------------------------------------------------------------------

TEST(AttractionRepulsion, StaysWhereALatticeTriangleIsReached) {
  const auto free = behaviour(attraction_kind, {{"cohesion.centroid.weight", 0.0}});
  EXPECT_TRUE(rc::check("equilateral triangle in any direction: zero displacement", [&] {
    const double angle = drawn_angle();
    Neighbours seen = neighbours_at({{300, 0}, {150, 300 * std::sqrt(0.75)}});
    seen = turned(seen, rotation(angle));
    RC_ASSERT(free->step({seen, 0}, unused_plan).position.norm() < 1e-3);
  }));
}

TEST(AttractionRepulsion, TurnsWithTheNeighboursAndIgnoresIdsPlanAndOrder) {
  const auto attraction = behaviour(attraction_kind);
  EXPECT_TRUE(rc::check("rotation, ids, plan, order", [&] {
    const Plan plan = drawn_plan(3, 12, 500);
    const Neighbours seen = drawn_neighbours(plan, 0);
    const Target target = attraction->step({seen, 0}, plan);
    RC_PRE(target.reason == Reason::placed);  // not on top of a neighbour

    const Target by_order = attraction->step({without_ids(shuffled(seen)), 0}, unused_plan);
    RC_ASSERT((by_order.position - target.position).norm() < 1e-3);

    const Transform2 turn = rotation(drawn_angle());
    const Target by_turned = attraction->step({turned(seen, turn), 0}, unused_plan);
    RC_ASSERT((by_turned.position - turn.rotate(target.position)).norm() < 1e-2);
  }));
}

// Degenerate swarms -----------------------------------------------------------------------------

TEST(AttractionRepulsion, HoldsWhenItHearsNoVehicle) {
  const Target target = behaviour(attraction_kind)->step({{}, 0}, unused_plan);
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(AttractionRepulsion, HoldsOnTopOfANeighbour) {
  const Target target =
      behaviour(attraction_kind)->step({neighbours_at({{0, 0}, {200, 0}}), 0}, unused_plan);
  EXPECT_EQ(target.reason, Reason::solver_failed);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(AttractionRepulsion, KeepsTheSeparationFromCoincidentNeighbours) {
  const Target target = behaviour(attraction_kind, {{"cohesion.centroid.weight", 0.0}})
                            ->step({neighbours_at({{150, 0}, {150, 0}}), 0}, unused_plan);
  EXPECT_NEAR((target.position - Vector2d(150, 0)).norm(), 300.0, 0.01);
}

TEST(AttractionRepulsion, AnswersAMirroredSwarmWithTheMirroredTarget) {
  const auto attraction = behaviour(attraction_kind);
  const Vector2d target = attraction->step({figure37, 0}, unused_plan).position;
  Neighbours mirrored = figure37;
  for (Neighbour& n : mirrored) n.position.x() *= -1.0;
  const Vector2d other = attraction->step({mirrored, 0}, unused_plan).position;
  EXPECT_LT((other - Vector2d(-target.x(), target.y())).norm(), 1e-3);
}

// Every potential with every selection and cohesion ----------------------------------------------

std::vector<std::string> fast_solvers() {
  std::vector<std::string> names;
  for (const std::string& name : Registry<solvers::Solver>::instance().names()) {
    const auto solver = Registry<solvers::Solver>::instance().make(name, Setting{}, "test");
    const bool fits = !solver->refuses({Vector2d(0, 0), solvers::differentiated<2>(Bowl{})});
    const bool is_fast = name.find("bfgs") != std::string::npos || name.starts_with("newton");
    if (fits && is_fast) names.push_back(name);
  }
  return names;
}

TEST(AttractionRepulsion, AnswersWithAFiniteTargetWhateverIsCombined) {
  const std::vector<std::string> solvers = fast_solvers();
  ASSERT_FALSE(solvers.empty());
  for (const auto& potential : Registry<Potential>::instance().names()) {
    for (const auto& selection : Registry<Selection>::instance().names()) {
      for (const auto& cohesion : Registry<Cohesion>::instance().names()) {
        for (const auto& solver : solvers) {
          const auto made = behaviour(attraction_kind, {{"potential.kind", potential},
                                                        {"selection.kind", selection},
                                                        {"cohesion.kind", cohesion},
                                                        {"solver.kind", solver}});
          const Plan plan = square_lattice(4, 3, 300.0);
          for (int own = 0; own < plan.size(); own += 5) {
            const Neighbours seen = heard(plan, own, rotation(own), {40.0 - 9.0 * own, 30});
            const Target target = made->step({seen, own, {.position = {70, -20}}}, plan);
            EXPECT_TRUE(target.position.allFinite() && std::isfinite(target.cost))
                << potential << ", " << selection << ", " << cohesion << ", " << solver;
            EXPECT_EQ(target.reason, Reason::placed)
                << potential << ", " << selection << ", " << cohesion << ", " << solver;
          }
        }
      }
    }
  }
}

class PotentialInABehaviour : public testing::TestWithParam<std::string> {};

TEST_P(PotentialInABehaviour, KeepsTheSeparationFromASingleNeighbour) {
  const auto made =
      behaviour(attraction_kind, {{"cohesion.kind", "none"}, {"potential.kind", GetParam()}});
  for (const Vector2d& p : {Vector2d(0, 290), Vector2d(-220, -220)}) {
    const Target target = made->step({neighbours_at({p}), 0}, unused_plan);
    EXPECT_NEAR((target.position - p).norm(), 300.0, 0.05);
  }
}

TEST_P(PotentialInABehaviour, TurnsWithTheNeighboursForEverySelection) {
  for (const auto& selection : Registry<Selection>::instance().names()) {
    const auto made =
        behaviour(attraction_kind, {{"potential.kind", GetParam()}, {"selection.kind", selection}});
    // Near a minimum, where there is one answer: far from any, turning may lead to another.
    for (const double angle : {0.4, 1.9, 3.0}) {
      const Neighbours seen =
          neighbours_at({{-290, 25}, {-160, -265}, {155, -270}, {310, -15}, {-20, -530}});
      const Target target = made->step({seen, 0}, unused_plan);
      const Target other = made->step({turned(seen, rotation(angle)), 0}, unused_plan);
      EXPECT_LT((other.position - rotation(angle).rotate(target.position)).norm(), 0.02)
          << selection;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Potentials, PotentialInABehaviour,
                         testing::ValuesIn(Registry<Potential>::instance().names()),
                         [](const auto& tested) { return tested.param; });

TEST(AttractionRepulsion, GoesByManyNeighboursIfTheSelectionSaysSo) {
  Neighbours crowd;
  for (int i = 0; i < 30; ++i) crowd.push_back({{200.0 + 10 * (i % 6), -60.0 + 25.0 * (i / 6)}});
  const Target target =
      behaviour(attraction_kind, {{"selection.kind", "in_range"}, {"cohesion.kind", "none"}})
          ->step({crowd, 0}, unused_plan);
  EXPECT_EQ(target.reason, Reason::placed);
  double sum = 0.0;
  for (const Neighbour& n : crowd) {
    const double r = (target.position - n.position).norm();
    sum += 300.0 * 300.0 * 300.0 / (2.0 * r * r) + r - 900.0;
  }
  EXPECT_NEAR(target.cost, sum, 1e-9);
}

TEST(AttractionRepulsion, IsDrawnToAWaypointInTheFrameOfTheOwnPositions) {
  const auto made = behaviour(
      attraction_kind,
      {{"cohesion.kind", "waypoint"}, {"cohesion.waypoint.weight", 1e-4}, {"combination", "mean"}});
  const Neighbours lone = neighbours_at({{0, 300}});
  EXPECT_TRUE(made->needs_waypoint());
  const Vector2d waypoint(5000, 0);
  const Target from_west = made->step({lone, 0, {.position = {0, 0}}, {}, waypoint}, unused_plan);
  const Target from_east =
      made->step({lone, 0, {.position = {10'000, 0}}, {}, waypoint}, unused_plan);
  EXPECT_GT(from_west.position.x(), 10.0);
  EXPECT_LT((from_east.position - Vector2d(-from_west.position.x(), from_west.position.y())).norm(),
            0.01);
}

// Damping, and lattices of squares ----------------------------------------------------------------

// A spring of 0.5 / m to a neighbour at 200 m, 100 m too near: k (100 + y) + d y = 0.
TEST(AttractionRepulsion, GoesPartOfTheWayIfItIsDamped) {
  for (const double damping : {0.0, 0.5, 2.0, 4.5}) {
    const Target target =
        behaviour(attraction_kind, {{"cohesion.kind", "none"},
                                    {"potential.kind", "virtual_spring"},
                                    {"potential.virtual_spring.stiffness_per_m", 0.5},
                                    {"damping_per_m", damping}})
            ->step({neighbours_at({{0, 200}}), 0}, unused_plan);
    EXPECT_LT((target.position - Vector2d(0, -100 * 0.5 / (0.5 + damping))).norm(), 1e-3);
  }
}

std::unique_ptr<Behaviour> for_squares(const std::string& potential = "thesis") {
  return behaviour(attraction_kind, {{"lattice", "squares"},
                                     {"selection.kind", "in_range"},
                                     {"cohesion.kind", "none"},
                                     {"contact_rangeout_m", 510.0},
                                     {"potential.kind", potential}});
}

TEST(AttractionRepulsion, KeepsLikeVehiclesOnTheDiagonalOfASquare) {
  const auto made = for_squares();
  const auto distance = [&](int slot) {
    const Neighbours seen{{{0, 400}, 0.0, slot}};
    return (made->step({seen, 2}, unused_plan).position - seen[0].position).norm();
  };
  EXPECT_NEAR(distance(3), 300.0, 0.01);
  EXPECT_NEAR(distance(1), 300.0, 0.01);
  EXPECT_NEAR(distance(4), 300.0 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(distance(0), 300.0 * std::sqrt(2.0), 0.01);
  EXPECT_TRUE(made->needs_ids());
  EXPECT_FALSE(behaviour(attraction_kind)->needs_ids());
  EXPECT_EQ(made->step({neighbours_at({{0, 400}}), 2}, unused_plan).reason, Reason::no_neighbour);
}

TEST_P(PotentialInABehaviour, ReturnsToItsPlaceInALatticeOfSquares) {
  const auto made = for_squares(GetParam());
  // Three columns: the parity of slots is that of a chequered board.
  const Plan plan = square_lattice(3, 3, 300.0);
  for (const double angle : {0.0, 0.7, 2.0}) {
    for (const int own : {0, 1, 4}) {  // a corner, an edge, the middle
      const Vector2d away = own == 4 ? Vector2d(20, -12) : Vector2d(4, -3);
      const Neighbours seen = heard(plan, own, rotation(angle), away);
      const Target target = made->step({seen, own}, plan);
      EXPECT_EQ(target.reason, Reason::placed);
      EXPECT_LT((target.position + away).norm(), 0.05) << "slot " << own;
    }
  }
}

// What cannot be combined -------------------------------------------------------------------------

std::string complaint(std::initializer_list<std::pair<const char*, Setting>> options) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, value);
  try {
    Registry<Behaviour>::instance().make(attraction_kind, table, "behaviour");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AttractionRepulsion, RefusesAFormulaThatIsNotFiniteAtItsDistances) {
  EXPECT_EQ(complaint({{"potential.kind", {"expression", {"swarm.toml", 4}}},
                       {"potential.expression.formula", {"log(r - s)", {"swarm.toml", 5}}}}),
            "swarm.toml:5: behaviour.potential.expression: formula \"log(r - s)\": it is not a "
            "number at r = 0.1 m for s = 300 m; change it, or the range from_m to to_m that it is "
            "meant for");
}

TEST(AttractionRepulsion, TakesAFormulaInTheRangeThatItIsMeantFor) {
  EXPECT_EQ(complaint({{"potential.kind", {"expression", {}}},
                       {"potential.expression.formula", {"(r-s)^2/log(r/100)", {}}},
                       {"potential.expression.from_m", {120.0, {}}}}),
            "");
}

TEST(AttractionRepulsion, RefusesASeparationOutsideTheRangeOfAFormula) {
  EXPECT_EQ(
      complaint(
          {{"potential.kind", {"expression", {}}}, {"potential.expression.to_m", {200.0, {}}}}),
      "behaviour.potential.expression: the separation, 300 m, is not between from_m and to_m");
}

TEST(AttractionRepulsion, RefusesAFormulaThatCannotBeReadWhereItIsWritten) {
  EXPECT_EQ(complaint({{"potential.expression.formula", {"r + q", {"swarm.toml", 5}}}}),
            "swarm.toml:5: behaviour.potential.expression: formula \"r + q\": there is no symbol "
            "\"q\"; known are r (distance, m), s (separation, m) and pi (character 5)");
}

/// A solver that refuses every problem.
struct Refuser final : solvers::Solver {
  solvers::Solution solve(const solvers::Problem&) const override { return {}; }
  std::optional<std::string> refuses(const solvers::Problem&) const override {
    return "needs bounds";
  }
  static void declare(Options<Refuser>&) {}
};
const Register<solvers::Solver, Refuser> refuser{"test_refuser", "needs bounds"};

TEST(AttractionRepulsion, RefusesASolverThatCannotTakeItsProblems) {
  EXPECT_EQ(complaint({{"solver.kind", {"test_refuser", {"swarm.toml", 9}}}}),
            "swarm.toml:9: behaviour.solver.test_refuser: needs bounds; choose a solver for two "
            "unknowns without bounds");
}

}  // namespace
}  // namespace shoal::formations
