#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "shoal/core/angles.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "tests/solvers/matching_support.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;
using tests::lattice;

struct Choices {
  double delta_theta_deg = 45.0;
  double tie_m = 0.5;
  bool plain = false;
  double ownship_weight = 1.0;
};

std::unique_ptr<Matcher> sampled(const Choices& choices) {
  Setting setting;
  setting.at_or_new("delta_theta_deg").value = choices.delta_theta_deg;
  setting.at_or_new("tie_m").value = choices.tie_m;
  setting.at_or_new("centroids").value = std::string(choices.plain ? "plain" : "weighted");
  return Registry<Matcher>::instance().make("sampled", setting, "matching.sampled");
}

struct Answer {
  std::vector<int> slot_of_point;
  double cost = 0.0, rotation = 0.0;
  bool usable = false;
};

Answer matched(const std::vector<Vector2d>& points, const std::vector<Vector2d>& slots,
               const Choices& choices, Memory* memory = nullptr) {
  const auto s = sampled(choices)->solve({points, slots, choices.ownship_weight}, memory);
  return {{s.slot_of_point.begin(), s.slot_of_point.end()}, s.cost, s.rotation, s.usable()};
}

Vector2d centre_of(const std::vector<Vector2d>& points, std::size_t special, double weight) {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += (i == special ? weight : 1.0) * points[i];
  return sum / (static_cast<double>(points.size()) - 1.0 + weight);
}

std::vector<Vector2d> about(std::vector<Vector2d> points, const Vector2d& centre) {
  for (Vector2d& p : points) p -= centre;
  return points;
}

// Rypkema 2015, Alg. 8 as written: all seeds, all turns, an assignment in each.
TurnedMatch plain_loop(const std::vector<Vector2d>& points, const std::vector<Vector2d>& slots,
                       const Choices& choices) {
  const double weight = choices.plain ? 1.0 : choices.ownship_weight;
  const auto aligned = about(points, centre_of(points, 0, weight));
  std::vector<double> cost_of_seed;
  for (const Vector2d& seed : slots) {
    std::vector<Vector2d> nearest = slots;
    std::ranges::stable_sort(nearest, {}, [&](const Vector2d& q) { return (q - seed).norm(); });
    std::size_t taken = points.size();
    const double last = (nearest[taken - 1] - seed).norm();
    while (taken < nearest.size() && (nearest[taken] - seed).norm() <= last + choices.tie_m) {
      ++taken;
    }
    nearest.resize(taken);
    const auto placed = about(nearest, centre_of(nearest, 0, weight));
    std::vector<double> cost_of_turn;
    for (int k = 1; k <= static_cast<int>(360.0 / choices.delta_theta_deg + 1e-9); ++k) {
      cost_of_turn.push_back(
          tests::assignment_cost(aligned, placed, radians(k * choices.delta_theta_deg)));
    }
    cost_of_seed.push_back(tests::first_of_the_least(cost_of_turn).cost);
  }
  return tests::first_of_the_least(cost_of_seed);
}

std::vector<Vector2d> hexagonal_by_rows(int columns, int rows, double separation_m) {
  std::vector<Vector2d> slots;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      slots.emplace_back(separation_m * (i + 0.5 * (j % 2)), separation_m * std::sqrt(0.75) * j);
    }
  }
  return slots;
}

TEST(Sampled, CostsWhatThePlainLoopOverSeedsAndTurnsCosts) {
  std::mt19937 generator(2);
  const std::vector plans{lattice(4, 5, 300.0), hexagonal_by_rows(4, 5, 300.0),
                          lattice(3, 3, 100.0)};
  for (int trial = 0; trial < 48; ++trial) {
    const auto& slots = plans[static_cast<std::size_t>(trial % 3)];
    const Choices choices{.delta_theta_deg = trial % 2 == 0 ? 10.0 : 33.0,
                          .tie_m = 0.5,
                          .plain = trial % 5 == 0,
                          .ownship_weight = trial % 4 == 0 ? 1.0 : 0.1};
    const double spread = trial % 7 < 3 ? 100.0 : 600.0;
    std::uniform_real_distribution<double> place(-spread, spread);
    std::vector<Vector2d> points;
    for (int i = 0; i < 1 + trial % 9; ++i) points.emplace_back(place(generator), place(generator));

    const Answer answer = matched(points, slots, choices);
    ASSERT_TRUE(answer.usable);
    EXPECT_NEAR(answer.cost, plain_loop(points, slots, choices).cost, 2.0 * cost_tie_m)
        << "trial " << trial;
  }
}

// A vehicle in the middle of a swarm that turns, spreads and jitters, and at times jumps.
std::vector<Vector2d> seen_at(int step, const std::vector<Vector2d>& slots,
                              std::mt19937& generator) {
  std::normal_distribution<double> jitter(0.0, step % 23 == 0 ? 15.0 : 0.2);
  const double turn = radians(0.1 * step), spread = 1.0 + 0.0005 * step;
  std::vector<Vector2d> points = {Vector2d::Zero()};
  for (const Vector2d& slot : slots) {
    const Vector2d placed = spread * (slot - slots[7]);
    const Vector2d from_here(std::cos(turn) * placed.x() - std::sin(turn) * placed.y(),
                             std::sin(turn) * placed.x() + std::cos(turn) * placed.y());
    const bool heard = placed.norm() < (step % 200 < 100 ? 650.0 : 500.0);
    if (&slot == &slots[7] || !heard) continue;
    points.push_back(from_here + Vector2d(jitter(generator), jitter(generator)));
  }
  return points;
}

TEST(Sampled, AnswersWithMemoryAsWithout) {
  std::mt19937 generator(4);
  const std::vector plans{lattice(4, 5, 300.0), hexagonal_by_rows(4, 5, 300.0)};
  for (const double delta_theta_deg : {10.0, 45.0}) {
    for (const bool plain : {true, false}) {
      const Choices choices{.delta_theta_deg = delta_theta_deg, .plain = plain};
      const auto matcher = sampled(choices);
      OwnedMemory memories[] = {matcher->new_memory(), matcher->new_memory()};
      for (int step = 0; step < 400; ++step) {
        // Two vehicles take turns; now and then they are asked about another plan.
        const auto& slots = plans[step % 150 < 120 ? 0 : 1];
        const auto points = seen_at(step, slots, generator);
        const Answer without = matched(points, slots, choices);
        for (OwnedMemory& memory : memories) {
          const auto with = matcher->solve({points, slots, choices.ownship_weight}, memory.get());
          ASSERT_TRUE(std::ranges::equal(with.slot_of_point, without.slot_of_point)) << step;
          ASSERT_EQ(with.cost, without.cost) << step;
          ASSERT_EQ(with.rotation, without.rotation) << step;
        }
      }
    }
  }
}

TEST(Sampled, BreaksTiesWithMemoryAsWithout) {
  // On the lattice itself, and half-way between two turns: many matches cost the same.
  const Choices choices{.delta_theta_deg = 10.0};
  for (const double turned_deg : {0.0, 5.0, 45.0, 90.0}) {
    const auto slots = lattice(3, 3, 100.0);
    const auto placed = tests::moved(slots, Transform2::from_angle(radians(turned_deg), {3, 4}));
    const Answer without = matched(placed, slots, choices);
    OwnedMemory memory = sampled(choices)->new_memory();
    for (int i = 0; i < 5; ++i) {
      auto shaken = placed;
      for (Vector2d& p : shaken) p *= 1.0 + 1e-9 * i;
      const Answer with = matched(shaken, slots, choices, memory.get());
      EXPECT_EQ(with.slot_of_point, without.slot_of_point) << turned_deg;
      EXPECT_EQ(with.rotation, without.rotation) << turned_deg;
    }
  }
}

TEST(Sampled, GivesEveryVehicleOfAPlacedFormationItsSlotUpToTheSymmetryOfTheLattice) {
  const auto slots = lattice(4, 5, 300.0);
  for (int k = 0; k < 36; k += 5) {
    const auto placed = tests::moved(slots, Transform2::from_angle(radians(10.0 * k), {800, -90}));
    const Answer answer = matched(placed, slots, {.delta_theta_deg = 10.0, .ownship_weight = 0.1});
    ASSERT_TRUE(answer.usable);
    EXPECT_NEAR(answer.cost, 0.0, 1e-8);
    // The lattice looks the same after half a turn: i or 19 - i.
    const bool upright = answer.slot_of_point[0] == 0;
    for (int i = 0; i < 20; ++i) {
      EXPECT_EQ(answer.slot_of_point[static_cast<std::size_t>(i)], upright ? i : 19 - i);
    }
    EXPECT_NEAR(std::abs(std::sin(answer.rotation + radians(10.0 * k))), 0.0, 1e-12);
  }
}

TEST(Sampled, FindsTheOnlySlotsThatFitAnIrregularPlan) {
  std::vector<Vector2d> slots{{0, 0}, {310, 20}, {640, -90}, {120, 450}, {500, 380}, {-240, 260}};
  const auto placed = tests::moved(slots, Transform2::from_angle(radians(-90.0), {5, 7}));
  const Answer answer = matched(placed, slots, {.delta_theta_deg = 45.0});
  EXPECT_EQ(answer.slot_of_point, (std::vector{0, 1, 2, 3, 4, 5}));
  EXPECT_NEAR(answer.rotation, radians(90.0), 1e-12);
}

TEST(Sampled, DoesNotCareInWhichOrderTheNeighboursAreHeard) {
  std::mt19937 generator(9);
  std::uniform_real_distribution<double> place(-500.0, 500.0);
  const auto slots = lattice(4, 5, 300.0);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Vector2d> points;
    for (int i = 0; i < 8; ++i) points.emplace_back(place(generator), place(generator));
    const Answer before = matched(points, slots, {.delta_theta_deg = 10.0});
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin() + 1, order.end(), generator);  // the own position stays first
    std::vector<Vector2d> shuffled;
    for (const std::size_t i : order) shuffled.push_back(points[i]);
    const Answer after = matched(shuffled, slots, {.delta_theta_deg = 10.0});
    EXPECT_NEAR(after.cost, before.cost, 1e-9);
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(after.slot_of_point[i], before.slot_of_point[order[i]]);
    }
  }
}

TEST(Sampled, DoesNotCareWhereTheVehiclesAre) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> place(-500.0, 500.0);
  const auto slots = lattice(4, 5, 300.0);
  std::vector<Vector2d> points;
  for (int i = 0; i < 9; ++i) points.emplace_back(place(generator), place(generator));
  const Answer here = matched(points, slots, {.ownship_weight = 0.1});
  const auto away = tests::moved(points, Transform2::from_angle(0.0, {5000, -3000}));
  const Answer there = matched(away, slots, {.ownship_weight = 0.1});
  EXPECT_EQ(there.slot_of_point, here.slot_of_point);
  EXPECT_NEAR(there.cost, here.cost, 1e-8);
}

TEST(Sampled, ForgetsThePlanOfTheCallBefore) {
  const auto first = lattice(4, 5, 300.0);
  auto second = first;
  for (Vector2d& slot : second) slot *= 0.5;
  const Choices choices{.delta_theta_deg = 10.0};
  EXPECT_NEAR(matched(first, first, choices).cost, 0.0, 1e-8);
  EXPECT_NEAR(matched(second, second, choices).cost, 0.0, 1e-8);
  EXPECT_GT(matched(second, first, choices).cost, 100.0);
  EXPECT_NEAR(matched(first, first, {.delta_theta_deg = 45.0}).cost, 0.0, 1e-8);
}

TEST(Sampled, TakesTheFirstSlotWhenAlone) {
  const Answer answer = matched({{12, 34}}, lattice(4, 5, 300.0), {});
  EXPECT_EQ(answer.slot_of_point, std::vector{0});
  EXPECT_EQ(answer.cost, 0.0);
}

TEST(Sampled, RefusesWhatItCannotMatch) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto slots = lattice(2, 2, 300.0);
  EXPECT_FALSE(matched({}, slots, {}).usable);
  EXPECT_FALSE(matched(lattice(5, 1, 300.0), slots, {}).usable) << "more points than slots";
  EXPECT_FALSE(matched({{0, nan}}, slots, {}).usable);
  EXPECT_FALSE(matched({{0, 0}}, {{0, 0}, {nan, 0}}, {}).usable);
  EXPECT_FALSE(matched({{0, 0}, {1, 1}}, slots, {.ownship_weight = -1.0}).usable);
  EXPECT_FALSE(matched({{0, 0}, {1, 1}}, slots, {.ownship_weight = nan}).usable);
  EXPECT_FALSE(matched({{0, 0}}, slots, {.ownship_weight = 0.0}).usable) << "no weight at all";
  EXPECT_TRUE(matched({{0, 0}, {300, 0}}, slots, {.ownship_weight = 0.0}).usable);
}

TEST(Sampled, RefusesAStepThatIsNoStep) {
  for (const double step : {0.0, 1e-7, -10.0, 181.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(sampled({.delta_theta_deg = step}), InputError) << step;
  }
  EXPECT_THROW(sampled({.tie_m = -1.0}), InputError);
}

}  // namespace
}  // namespace shoal::solvers
