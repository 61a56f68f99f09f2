#include "shoal/analysis/experiments/measures/slot_keeping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace shoal::analysis {
namespace {

std::vector<Eigen::Vector2d> lattice_slots() {
  std::vector<Eigen::Vector2d> slots;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) slots.emplace_back(300.0 * column, 300.0 * row);
  }
  return slots;
}

void add_instant(std::vector<Eigen::Vector2f>& places, const std::vector<Eigen::Vector2d>& swarm,
                 double angle, const Eigen::Vector2d& moved) {
  for (const Eigen::Vector2d& p : swarm) {
    const Eigen::Vector2d turned(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                 std::sin(angle) * p.x() + std::cos(angle) * p.y());
    places.push_back((turned + moved).cast<float>());
  }
}

TEST(SlotKeeping, DoesNotMindWhereAFormationDriftsAndHowItTurns) {
  std::vector<Eigen::Vector2f> places;
  for (int k = 0; k < 5; ++k) add_instant(places, lattice_slots(), 0.7 * k, {100.0 * k, -50.0 * k});
  const SlotKeeping keeping(lattice_slots(), places);
  ASSERT_EQ(keeping.instants(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(keeping.mean_m(k), 0.0, 1e-3);  // floats
    EXPECT_TRUE(keeping.elsewhere(k, 300.0).empty());
  }
}

TEST(SlotKeeping, OfTwoVehiclesIsHalfTheErrorOfTheirDistance) {
  const std::vector<Eigen::Vector2f> places = {{0, 0}, {400, 0}, {0, 0}, {0, 280}};
  const SlotKeeping keeping(std::vector<Eigen::Vector2d>{{0, 0}, {300, 0}}, places);
  EXPECT_NEAR(keeping.mean_m(0), 50.0, 1e-9);
  EXPECT_NEAR(keeping.mean_m(1), 10.0, 1e-9);
}

TEST(SlotKeeping, KnowsTheVehicleThatCameFromAnotherSlot) {
  std::vector<Eigen::Vector2d> before = lattice_slots();
  before[19] += Eigen::Vector2d(300.0, 0.0);  // outside the outline; in the end it is in its corner
  std::vector<Eigen::Vector2f> places;
  add_instant(places, before, 0.3, {0.0, 0.0});
  add_instant(places, lattice_slots(), 0.3, {0.0, 0.0});
  const SlotKeeping keeping(lattice_slots(), places);
  EXPECT_EQ(keeping.elsewhere(0, 300.0), std::vector<std::size_t>{19});
  EXPECT_TRUE(keeping.elsewhere(1, 300.0).empty());
}

}  // namespace
}  // namespace shoal::analysis
