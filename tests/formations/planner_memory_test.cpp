// What a planner remembers, and its copies.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shoal/formations/guidances/drift.hpp"
#include "tests/formations/engineer.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

/// A vehicle in a lattice that turns, spreads and jitters; `swarm` sets it off from others.
class Wanderer {
 public:
  Wanderer(const char* kind, int swarm)
      : lattice_(square_lattice(4, swarm == 0 ? 4 : 3, 300.0)),
        swarm_(swarm),
        planner_(shared(lattice_), behaviour(kind), "v0", {.guidance = std::make_shared<Drift>()}) {
  }

  /// The target and the command of a step, as numbers.
  std::vector<double> step(int number) {
    const double time_s = 30.0 * number;
    const Vector2d own = start + number * Vector2d(3, -2 * swarm_);
    Neighbours seen = heard(lattice_, 0, rotation(0.02 * number + swarm_), {10.0 * swarm_, 5});
    for (Neighbour& n : seen) {
      n.position += Vector2d(std::sin(7.0 * n.slot + number), std::cos(3.0 * n.slot - number));
      planner_.receive(ping_of(n, time_s), own);
    }
    const Target target = planner_.plan(time_s + 0.5, {.position = own});
    const Command command = planner_.command({.position = own});
    return {target.position.x(), target.position.y(), target.cost, command.heading_rad,
            command.speed_m_s};
  }

 private:
  Plan lattice_;
  int swarm_;
  Planner planner_;
};

class MemoryOfPlanner : public testing::TestWithParam<std::string> {};

TEST_P(MemoryOfPlanner, IsCopiedWithIt) {
  Wanderer original(GetParam().c_str(), 0);
  for (int i = 0; i < 40; ++i) original.step(i);
  Wanderer copy = original;
  Wanderer another = copy;
  for (int i = 40; i < 60; ++i) {
    const auto expected = original.step(i);
    EXPECT_EQ(copy.step(i), expected) << i;
  }
  for (int i = 40; i < 60; ++i) another.step(i);
  EXPECT_EQ(another.step(60), original.step(60));
}

TEST_P(MemoryOfPlanner, IsNotSharedWithAnotherSwarmOnTheThread) {
  std::vector<std::vector<double>> alone[2], alternately[2];
  for (int swarm = 0; swarm < 2; ++swarm) {
    Wanderer wanderer(GetParam().c_str(), swarm);
    for (int i = 0; i < 60; ++i) alone[swarm].push_back(wanderer.step(i));
  }
  Wanderer first(GetParam().c_str(), 0), second(GetParam().c_str(), 1);
  for (int i = 0; i < 60; ++i) {
    alternately[0].push_back(first.step(i));
    alternately[1].push_back(second.step(i));
  }
  EXPECT_EQ(alternately[0], alone[0]);
  EXPECT_EQ(alternately[1], alone[1]);
}

INSTANTIATE_TEST_SUITE_P(Behaviours, MemoryOfPlanner,
                         testing::Values("rigid_registration", "pairwise_referencing",
                                         "assignment_registration", "attraction_repulsion"),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

}  // namespace
}  // namespace shoal::formations
