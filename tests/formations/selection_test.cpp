#include "shoal/formations/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/formations/swarm.hpp"
#include "tests/support/allocation_count.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

std::unique_ptr<Selection> selection(const std::string& kind, Table options = {}) {
  Setting table;
  for (const auto& [path, value] : options) assign(table, path, Setting{value, {}});
  return Registry<Selection>::instance().make(kind, table, "test");
}

std::vector<int> chosen(const Selection& selection, const Neighbours& swarm) {
  std::vector<int> indices{7, 8, 9};  // what was there goes
  selection.select(swarm, indices);
  std::ranges::sort(indices);
  return indices;
}

using Indices = std::vector<int>;

/// Neighbours without ties: on a grid of centimetres, some metres apart.
Neighbours drawn_swarm(int most = 12) {
  return without_ids(heard(drawn_plan(2, most), 0));
}

// Every registered selection
// ------------------------------------------------------------------------

class EverySelection : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Selection> made = selection(GetParam());
};

TEST_P(EverySelection, ChoosesSomeNeighboursOnceEach) {
  EXPECT_TRUE(rc::check("indices, at least one, none twice", [&] {
    const Neighbours swarm = drawn_swarm();
    const Indices indices = chosen(*made, swarm);
    RC_ASSERT(!indices.empty());
    RC_ASSERT(indices.front() >= 0 && indices.back() < static_cast<int>(swarm.size()));
    RC_ASSERT(std::ranges::adjacent_find(indices) == indices.end());
  }));
}

TEST_P(EverySelection, DoesNotDependOnOrderIdsAndAges) {
  EXPECT_TRUE(rc::check("the same positions", [&] {
    Neighbours swarm = drawn_swarm();
    const std::vector<int> order = drawn_order(static_cast<int>(swarm.size()));
    Neighbours mixed;
    for (const int i : order) {
      mixed.push_back(swarm[static_cast<std::size_t>(i)]);
      mixed.back().slot = 3 * i;
      mixed.back().age_s = i;
    }
    Indices back;
    for (const int i : chosen(*made, mixed)) back.push_back(order[static_cast<std::size_t>(i)]);
    std::ranges::sort(back);
    RC_ASSERT(back == chosen(*made, swarm));
  }));
}

TEST_P(EverySelection, TurnsAndMirrorsWithTheSwarm) {
  EXPECT_TRUE(rc::check("the same indices", [&] {
    const Neighbours swarm = drawn_swarm();
    Neighbours moved = turned(swarm, rotation(drawn_angle()));
    if (drawn_int(0, 1) == 1) {
      for (Neighbour& n : moved) n.position.x() *= -1.0;
    }
    RC_ASSERT(chosen(*made, moved) == chosen(*made, swarm));
  }));
}

TEST_P(EverySelection, AnswersEveryDegenerateSwarm) {
  EXPECT_TRUE(chosen(*made, {}).empty());
  for (const Neighbours& swarm : {
           neighbours_at({{200, 0}}),
           neighbours_at({{0, 0}}),
           neighbours_at({{0, 0}, {0, 0}}),
           neighbours_at({{0, 0}, {100, 0}}),
           neighbours_at({{50, 0}, {50, 0}, {50, 0}}),
           neighbours_at({{100, 0}, {-100, 0}}),
           neighbours_at({{100, 100}, {200, 200}, {300, 300}}),
           neighbours_at({{1e-300, 0}, {-1e-300, 1e-300}}),
           neighbours_at({{1e-12, 0}, {0, 1e-12}, {300, 0}}),
           neighbours_at({{1e150, 0}, {0, -1e150}, {1e150, 1e150}}),
           neighbours_at({{300, 0}, {0, 300}, {-300, 0}, {0, -300}, {300, 300}, {-300, -300}}),
       }) {
    const Indices indices = chosen(*made, swarm);
    EXPECT_FALSE(indices.empty());
    EXPECT_TRUE(std::ranges::adjacent_find(indices) == indices.end());
    if (!indices.empty()) {
      EXPECT_GE(indices.front(), 0);
      EXPECT_LT(indices.back(), static_cast<int>(swarm.size()));
    }
  }
}

TEST_P(EverySelection, AllocatesNothingOnceItHasSeenASwarm) {
  if (GetParam() == "delaunay") GTEST_SKIP() << "CGAL allocates";
  const Neighbours swarm = heard(square_lattice(4, 3, 300.0), 5, rotation(0.3));
  std::vector<int> indices;
  made->select(swarm, indices);
  const auto before = shoal::tests::allocations();
  made->select(swarm, indices);
  EXPECT_EQ(shoal::tests::allocations() - before, 0u);
}

INSTANTIATE_TEST_SUITE_P(Selections, EverySelection,
                         testing::ValuesIn(Registry<Selection>::instance().names()),
                         [](const auto& tested) { return tested.param; });

// Each by its definition --------------------------------------------------------------------------

TEST(TwoNeighbours, AreTheNearestAndTheOneOfTheShortestTriangle) {
  const auto two = selection("two_neighbours");
  // The second nearest (310 m, but opposite) makes a longer triangle than the third.
  EXPECT_EQ(chosen(*two, neighbours_at({{-310, 0}, {250, 0}, {200, 280}})), (Indices{1, 2}));
  EXPECT_EQ(chosen(*two, neighbours_at({{-310, 0}})), (Indices{0}));
}

TEST(InRange, IsEverybody) {
  EXPECT_EQ(chosen(*selection("in_range"), neighbours_at({{3, 0}, {1, 0}, {1, 0}})),
            (Indices{0, 1, 2}));
}

TEST(KNearest, AreTheKNearest) {
  const Neighbours swarm = neighbours_at({{400, 0}, {0, 100}, {-300, 0}, {0, -200}});
  EXPECT_EQ(chosen(*selection("k_nearest", {{"k", std::int64_t{2}}}), swarm), (Indices{1, 3}));
  EXPECT_EQ(chosen(*selection("k_nearest", {{"k", std::int64_t{9}}}), swarm),
            (Indices{0, 1, 2, 3}));
  // Of a tie the first: two of these are 1 m away.
  EXPECT_EQ(
      chosen(*selection("k_nearest", {{"k", std::int64_t{1}}}), neighbours_at({{0, 1}, {1, 0}})),
      (Indices{0}));
}

TEST(AcuteAngle, HasNoDiagonalInALatticeOfSquaresAndSixSpringsInOneOfTriangles) {
  const auto acute = selection("acute_angle");
  EXPECT_EQ(chosen(*acute, neighbours_at({{300, 0}, {0, 300}, {300, 300}, {-300, 0}})),
            (Indices{0, 1, 3}));
  const double h = 300.0 * std::sqrt(0.75);
  EXPECT_EQ(chosen(*acute, neighbours_at({{300, 0},
                                          {150, h},
                                          {-150, h},
                                          {-300, 0},
                                          {-150, -h},
                                          {150, -h},
                                          {450, h},
                                          {600, 0}})),
            (Indices{0, 1, 2, 3, 4, 5}));
}

TEST(AcuteAngle, IsCutByAVehicleInBetween) {
  const auto acute = selection("acute_angle");
  EXPECT_EQ(chosen(*acute, neighbours_at({{300, 0}, {150, 100}})),
            (Indices{1}));  // under 112 degrees
  EXPECT_EQ(chosen(*acute, neighbours_at({{300, 0}, {150, 200}})),
            (Indices{0, 1}));  // under 74 degrees
  EXPECT_EQ(chosen(*acute, neighbours_at({{300, 0}, {300, 0}})), (Indices{0, 1}));
}

TEST(AcuteAngle, IsTheGabrielGraph) {
  const auto acute = selection("acute_angle");
  EXPECT_TRUE(rc::check("no vehicle inside the circle over own and neighbour", [&] {
    const Neighbours swarm = drawn_swarm(20);
    const Indices indices = chosen(*acute, swarm);
    const std::set<int> sprung(indices.begin(), indices.end());
    for (std::size_t i = 0; i < swarm.size(); ++i) {
      const Vector2d centre = 0.5 * swarm[i].position;
      double clearance = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < swarm.size(); ++j) {
        if (j != i) {
          clearance = std::min(clearance, (swarm[j].position - centre).norm() - centre.norm());
        }
      }
      RC_PRE(std::abs(clearance) > 1e-6);
      RC_ASSERT(sprung.contains(static_cast<int>(i)) == (clearance > 0.0));
    }
  }));
}

TEST(Delaunay, AreThoseWithAnEmptyCircleThroughOwnAndNeighbour) {
  const auto delaunay = selection("delaunay");
  EXPECT_TRUE(rc::check("circles of the bisector", [&] {
    const Neighbours swarm = drawn_swarm(20);
    const Indices indices = chosen(*delaunay, swarm);
    const std::set<int> adjacent(indices.begin(), indices.end());
    for (std::size_t i = 0; i < swarm.size(); ++i) {
      // Centres b/2 + t n; every other neighbour leaves the circle empty for t on one side.
      const Vector2d b = swarm[i].position;
      const Vector2d n(-b.y(), b.x());
      double low = -1e9, high = 1e9;
      for (std::size_t j = 0; j < swarm.size(); ++j) {
        if (j == i) continue;
        const Vector2d c = swarm[j].position;
        const double side = c.dot(n);
        RC_PRE(std::abs(side) > 1e-3);
        const double t = (c.squaredNorm() - c.dot(b)) / (2.0 * side);
        (side > 0.0 ? high : low) = side > 0.0 ? std::min(high, t) : std::max(low, t);
      }
      RC_PRE(std::abs(high - low) > 1e-9);
      RC_ASSERT(adjacent.contains(static_cast<int>(i)) == (high > low));
    }
  }));
}

TEST(Delaunay, OnOneLineAreTheNextOnEitherSide) {
  const auto delaunay = selection("delaunay");
  EXPECT_EQ(chosen(*delaunay, neighbours_at({{300, 0}, {100, 0}, {-200, 0}, {-500, 0}})),
            (Indices{1, 2}));
  EXPECT_EQ(chosen(*delaunay, neighbours_at({{1, 1}, {2, 2}, {3, 3}})), (Indices{0}));
}

TEST(Delaunay, ChoosesThoseOnTopOfOneAnotherTogether) {
  const auto delaunay = selection("delaunay");
  EXPECT_EQ(chosen(*delaunay, neighbours_at({{300, 0}, {300, 0}, {0, 300}})), (Indices{0, 1, 2}));
  EXPECT_EQ(chosen(*delaunay, neighbours_at({{0, 0}, {300, 0}})), (Indices{0, 1}));
}

}  // namespace
}  // namespace shoal::formations
