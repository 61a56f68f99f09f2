#include "shoal/formations/cohesion.hpp"

#include <gtest/gtest.h>

#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

std::unique_ptr<Cohesion> cohesion(const std::string& kind, Table options = {}) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, Setting{value, {}});
  return Registry<Cohesion>::instance().make(kind, table, "test");
}

const Neighbours three_neighbours{{{300, 0}}, {{0, 600}}, {{-600, 0}}};

class EveryCohesion : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cohesion> made = cohesion(GetParam());
};

TEST_P(EveryCohesion, HasTheDerivativesOfItsValue) {
  for (const Vector2d& p : {Vector2d(100, -30), Vector2d(-1, 2), Vector2d(0, 0)}) {
    constexpr double h = 0.1;
    const PlaneValue exact = made->at(p);
    for (int i = 0; i < 2; ++i) {
      const Vector2d step = h * Vector2d::Unit(i);
      const double slope = (made->at(p + step).value - made->at(p - step).value) / (2 * h);
      EXPECT_NEAR(exact.gradient[i], slope, 1e-10);
      const Vector2d bend = (made->at(p + step).gradient - made->at(p - step).gradient) / (2 * h);
      EXPECT_LT((exact.hessian.col(i) - bend).norm(), 1e-12);
    }
  }
}

TEST_P(EveryCohesion, IsLeastAtItsAnchor) {
  for (const Vector2d& p : {Vector2d(100, -30), Vector2d(-1, 2)}) {
    EXPECT_LE(made->at({0, 0}).value, made->at(p).value);
    EXPECT_GE(made->at(p).gradient.dot(p), 0.0);
  }
}

TEST_P(EveryCohesion, HasAnAnchorThatTurnsWithTheWorldWhateverTheOrder) {
  const Transform2 turn = rotation(0.7);
  const Vector2d waypoint(500, 100);
  const Vector2d anchor = made->anchor(three_neighbours, waypoint);
  EXPECT_TRUE(anchor.allFinite());
  EXPECT_LT(
      (made->anchor(turned(three_neighbours, turn), turn.rotate(waypoint)) - turn.rotate(anchor))
          .norm(),
      1e-9);
  const Neighbours reversed(three_neighbours.rbegin(), three_neighbours.rend());
  EXPECT_LT((made->anchor(reversed, waypoint) - anchor).norm(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Cohesions, EveryCohesion,
                         testing::ValuesIn(Registry<Cohesion>::instance().names()),
                         [](const auto& tested) { return tested.param; });

TEST(NoCohesion, IsNothing) {
  EXPECT_EQ(cohesion("none")->at({3, 4}).value, 0.0);
  EXPECT_EQ(cohesion("none")->at({3, 4}).gradient, Vector2d(0, 0));
}

TEST(Centroid, IsThatOfTheNeighboursOrOfAll) {
  const Vector2d waypoint(1e6, 1e6);  // does not matter
  EXPECT_EQ(cohesion("centroid")->anchor(three_neighbours, waypoint), Vector2d(-100, 200));
  EXPECT_EQ(cohesion("centroid", {{"counts_own", true}})->anchor(three_neighbours, waypoint),
            Vector2d(-75, 150));
  EXPECT_DOUBLE_EQ(cohesion("centroid")->at({300, 400}).value, 1e-5 * 250'000.0);
}

TEST(Waypoint, IsTheSamePlaceFromEverywhere) {
  const auto waypoint = cohesion("waypoint", {{"weight", 2.0}});
  EXPECT_TRUE(waypoint->needs_waypoint());
  EXPECT_EQ(waypoint->anchor(three_neighbours, {100, -100}), Vector2d(100, -100));
  EXPECT_DOUBLE_EQ(waypoint->at({3, 4}).value, 50.0);
  EXPECT_EQ(waypoint->at({3, 4}).gradient, Vector2d(12, 16));
}

}  // namespace
}  // namespace shoal::formations
