#include <gtest/gtest.h>

#include "shoal/solvers/autodiff.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/formations/swarm.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

const char* const kind = "attraction_repulsion";
const Plan unused = plan_of({{0, 0}});

Neighbours at(std::initializer_list<Vector2d> positions) {
  Neighbours all;
  for (const Vector2d& p : positions) all.push_back({p, 0.0, anonymous});
  return all;
}

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
const Neighbours figure37 = at({{-280, -81}, {-25, -193}});
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

class EnrolledSolver : public testing::TestWithParam<std::string> {};

TEST_P(EnrolledSolver, FindsThePlaceOfFigure37) {
  const auto solver = Registry<solvers::Solver>::instance().make(GetParam(), Setting{}, "test");
  if (const auto why = solver->refuses({Vector2d(0, 0), solvers::differentiated<2>(Bowl{})})) {
    GTEST_SKIP() << GetParam() << " " << *why;
  }
  const auto target = [&](double centroid_weight) {
    return behaviour(kind, {{"centroid_weight", centroid_weight}, {"solver.kind", GetParam()}})
        ->step({figure37, 0}, unused);
  };
  EXPECT_EQ(target(0.0).reason, Reason::placed);
  EXPECT_LT((target(0.0).position - equidistant37).norm(), 1e-3);
  EXPECT_NEAR(target(0.0).cost, -900.0, 1e-6);  // twice -1.5 s
  EXPECT_LT((target(1e-5).position - answer37).norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Solvers, EnrolledSolver,
                         testing::ValuesIn(Registry<solvers::Solver>::instance().names()),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

// The choice of neighbours, and the centroid ----------------------------------------------------

TEST(AttractionRepulsion, ChoosesTheNearestAndTheOneOfTheShortestTriangle) {
  // The second nearest (310 m, but opposite) makes a longer triangle than the third.
  const Neighbours seen = at({{-310, 0}, {250, 0}, {200, 280}});
  const auto without_centroid = behaviour(kind, {{"centroid_weight", 0.0}});
  const Vector2d target = without_centroid->step({seen, 0}, unused).position;
  EXPECT_NEAR((target - seen[1].position).norm(), 300.0, 0.01);
  EXPECT_NEAR((target - seen[2].position).norm(), 300.0, 0.01);
}

TEST(AttractionRepulsion, IgnoresNeighboursOutOfRange) {
  const auto near_only = behaviour(kind, {{"contact_rangeout_m", 300.0}});
  const auto all_near = near_only->step({at({{-200, -81}, {-25, -193}}), 0}, unused);
  const auto with_far = near_only->step({at({{0, 301}, {-200, -81}, {-25, -193}}), 0}, unused);
  EXPECT_EQ(all_near.position, with_far.position);
  EXPECT_EQ(near_only->step({at({{0, 301}}), 0}, unused).reason, Reason::no_neighbour);
}

TEST(AttractionRepulsion, MinimisesTheSumAndThePullOfTheCentroidOfAllNeighbours) {
  const Neighbours seen = at({{-280, -81}, {-25, -193}, {600, 150}});
  const Vector2d centroid = (seen[0].position + seen[1].position + seen[2].position) / 3.0;
  const Target target = behaviour(kind)->step({seen, 0}, unused);
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
  const Vector2d centroid = (figure37[0].position + figure37[1].position) / 3.0;
  const Target target =
      behaviour(kind, {{"combination", "mean"}, {"centroid", "neighbours_and_own"}})
          ->step({figure37, 0}, unused);
  const auto expected = [&](const Vector2d& p) { return cost(p, figure37, centroid, 0.5); };
  EXPECT_NEAR(target.cost, expected(target.position), 1e-9);
  for (int i = 0; i < 12; ++i) {
    const Vector2d step = 0.05 * Vector2d(std::cos(0.5236 * i), std::sin(0.5236 * i));
    EXPECT_LT(target.cost, expected(target.position + step));
  }
}

// One neighbour at 200 m: f'(r) = share * (1 - (s/r)^3) + 2 w (r - distance to the centroid).
TEST(AttractionRepulsion, KeepsTheSeparationFromASingleNeighbour) {
  const Target free =
      behaviour(kind, {{"centroid_weight", 0.0}})->step({at({{0, 200}}), 0}, unused);
  EXPECT_LT((free.position - Vector2d(0, -100)).norm(), 0.01);
}

TEST(AttractionRepulsion, TakesTheSeparationFromItsOptions) {
  const Target target = behaviour(kind, {{"centroid_weight", 0.0}, {"separation_m", 60.0}})
                            ->step({at({{100, 0}}), 0}, unused);
  EXPECT_LT((target.position - Vector2d(40, 0)).norm(), 0.01);
}

// Invariance ------------------------------------------------------------------------------------

TEST(AttractionRepulsion, StaysWhereALatticeTriangleIsReached) {
  const auto free = behaviour(kind, {{"centroid_weight", 0.0}});
  EXPECT_TRUE(rc::check("equilateral triangle in any direction: zero displacement", [&] {
    const double angle = drawn_angle();
    Neighbours seen = at({{300, 0}, {150, 300 * std::sqrt(0.75)}});
    seen = turned(seen, rotation(angle));
    RC_ASSERT(free->step({seen, 0}, unused).position.norm() < 1e-3);
  }));
}

TEST(AttractionRepulsion, TurnsWithTheNeighboursAndIgnoresIdsPlanAndOrder) {
  const auto attraction = behaviour(kind);
  EXPECT_TRUE(rc::check("rotation, ids, plan, order", [&] {
    const Plan plan = drawn_plan(3, 12, 500);
    const Neighbours seen = drawn_neighbours(plan, 0);
    const Target target = attraction->step({seen, 0}, plan);
    RC_PRE(target.reason == Reason::placed);  // not on top of a neighbour

    const Target by_order = attraction->step({without_ids(shuffled(seen)), 0}, unused);
    RC_ASSERT((by_order.position - target.position).norm() < 1e-3);

    const Transform2 turn = rotation(drawn_angle());
    const Target by_turned = attraction->step({turned(seen, turn), 0}, unused);
    RC_ASSERT((by_turned.position - turn.rotate(target.position)).norm() < 1e-2);
  }));
}

// Degenerate swarms -----------------------------------------------------------------------------

TEST(AttractionRepulsion, HoldsWhenItHearsNobody) {
  const Target target = behaviour(kind)->step({{}, 0}, unused);
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(AttractionRepulsion, HoldsOnTopOfANeighbour) {
  const Target target = behaviour(kind)->step({at({{0, 0}, {200, 0}}), 0}, unused);
  EXPECT_EQ(target.reason, Reason::solver_failed);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST(AttractionRepulsion, KeepsTheSeparationFromCoincidentNeighbours) {
  const Target target =
      behaviour(kind, {{"centroid_weight", 0.0}})->step({at({{150, 0}, {150, 0}}), 0}, unused);
  EXPECT_NEAR((target.position - Vector2d(150, 0)).norm(), 300.0, 0.01);
}

TEST(AttractionRepulsion, AnswersAMirroredSwarmWithTheMirroredTarget) {
  const auto attraction = behaviour(kind);
  const Vector2d target = attraction->step({figure37, 0}, unused).position;
  Neighbours mirrored = figure37;
  for (Neighbour& n : mirrored) n.position.x() *= -1.0;
  const Vector2d other = attraction->step({mirrored, 0}, unused).position;
  EXPECT_LT((other - Vector2d(-target.x(), target.y())).norm(), 1e-3);
}

}  // namespace
}  // namespace shoal::formations
