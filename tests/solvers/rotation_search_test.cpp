#include "shoal/solvers/matching/rotation_search.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "shoal/core/angles.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/transform.hpp"
#include "tests/solvers/matching_support.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using tests::lattice;

// All turns in order, an assignment from nothing in each.
TurnedMatch plain_loop(const std::vector<Vector2d>& points, const std::vector<Vector2d>& slots,
                       double step_deg, int turns) {
  std::vector<double> costs;
  for (int turn = 0; turn < turns; ++turn) {
    costs.push_back(tests::assignment_cost(points, slots, radians((turn + 1) * step_deg)));
  }
  return tests::first_of_the_least(costs);
}

TurnedMatch searched(const std::vector<Vector2d>& points, const std::vector<Vector2d>& slots,
                     double step_deg) {
  RotationSearch search;
  search.set_points(points);
  return search.search(Turns(step_deg), AlignedSlots(slots, {0, 0}));
}

TEST(Turns, MakeAFullCircleAndNoMore) {
  EXPECT_EQ(Turns(10.0).count(), 36);
  EXPECT_EQ(Turns(45.0).count(), 8);
  EXPECT_EQ(Turns(7.0).count(), 51);
  EXPECT_EQ(Turns(180.0).count(), 2);
  EXPECT_EQ(Turns(360.0 / 7.0).count(), 7) << "division with rounding";
  EXPECT_EQ(Turns(0.1).count(), 3600) << "division with rounding";
  EXPECT_NEAR(Turns(10.0).angle(0), radians(10.0), 1e-15);
  EXPECT_NEAR(Turns(10.0).cosine(35), 1.0, 1e-15);
}

TEST(Turns, KnowWhichRotationsOnlyPermuteThem) {
  EXPECT_TRUE(Turns(10.0).permuted_by(90.0));
  EXPECT_TRUE(Turns(10.0).permuted_by(60.0));
  EXPECT_FALSE(Turns(45.0).permuted_by(60.0));
  EXPECT_FALSE(Turns(50.0).permuted_by(100.0)) << "50 degrees do not close the circle";
  EXPECT_TRUE(Turns(50.0).permuted_by(0.0));
}

TEST(Turns, RefuseAStepThatIsNoStep) {
  for (const double step : {0.0, -10.0, 361.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(Turns{step}, InputError) << step;
  }
}

TEST(RotationSearch, GivesTheAnswerOfThePlainLoop) {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 60; ++trial) {
    const double spread = trial % 3 == 0 ? 100.0 : trial % 3 == 1 ? 400.0 : 1000.0;
    std::uniform_real_distribution<double> place(-spread, spread);
    const int count = 1 + trial % 20;
    const double step_deg = std::array{10.0, 45.0, 33.0}[static_cast<std::size_t>(trial % 3)];
    const auto slots = tests::centred(lattice(6, trial % 2 == 0 ? 7 : 4, 300.0));
    std::vector<Vector2d> points;
    for (int i = 0; i < count; ++i) points.emplace_back(place(generator), place(generator));

    const TurnedMatch expected = plain_loop(points, slots, step_deg, Turns(step_deg).count());
    const TurnedMatch found = searched(points, slots, step_deg);
    EXPECT_EQ(found.turn, expected.turn) << "trial " << trial;
    EXPECT_NEAR(found.cost, expected.cost, 1e-9) << "trial " << trial;
  }
}

TEST(RotationSearch, PrefersTheFirstOfEqualTurns) {
  // A square fits a square lattice after every quarter turn.
  const auto slots = tests::centred(lattice(2, 2, 300.0));
  const TurnedMatch found = searched(slots, slots, 10.0);
  EXPECT_EQ(found.turn, 8);
  EXPECT_NEAR(found.cost, 0.0, 1e-10);
}

TEST(RotationSearch, UndoesTheRotationOfAFormation) {
  const auto slots = tests::centred(lattice(4, 5, 300.0));
  const auto turned = tests::moved(slots, Transform2::from_angle(radians(-70.0), {0, 0}));
  RotationSearch search;
  const Turns turns(10.0);
  const AlignedSlots aligned(slots, {0, 0});
  search.set_points(turned);
  const TurnedMatch found = search.search(turns, aligned);
  EXPECT_EQ(found.turn, 6);
  search.match(turns, aligned, found.turn);
  EXPECT_NEAR(search.cost(), 0.0, 1e-9);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    EXPECT_EQ(search.slot_of_point()[i], static_cast<int>(i));
  }
}

TEST(RotationSearch, FindsNothingBelowALimitThatIsTooLowAndTheSameJustAboveIt) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> place(-300.0, 300.0);
  const auto slots = tests::centred(lattice(4, 5, 300.0));
  RotationSearch search;
  const Turns turns(10.0);
  const AlignedSlots aligned(slots, {0, 0});
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 13; ++i) points.emplace_back(place(generator), place(generator));
    search.set_points(points);
    const TurnedMatch best = search.search(turns, aligned);
    EXPECT_EQ(search.search(turns, aligned, best.cost - 1e-3).turn, -1);
    EXPECT_EQ(search.search(turns, aligned, best.cost + 1e-3).turn, best.turn);
    EXPECT_LE(search.bound_below(aligned), best.cost + 1e-9);
  }
}

TEST(RotationSearch, RefusesMorePointsThanSlots) {
  const auto slots = lattice(2, 2, 300.0);
  RotationSearch search;
  search.set_points(lattice(3, 2, 300.0));
  EXPECT_THROW(search.search(Turns(45.0), AlignedSlots(slots, {0, 0})), std::invalid_argument);
  EXPECT_THROW(search.match(Turns(45.0), AlignedSlots(slots, {0, 0}), 0), std::invalid_argument);
}

}  // namespace
}  // namespace shoal::solvers
