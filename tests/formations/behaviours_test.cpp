// What holds for every registered behaviour: a new one is tested by being there.

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "tests/formations/swarm.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

class EveryBehaviour : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Behaviour> made = behaviour(GetParam());
};

/// Neighbours that no formation would have, and the worst that pings may report.
std::vector<Neighbours> degenerate_swarms() {
  const auto at = [](std::initializer_list<Vector2d> positions) {
    Neighbours all;
    for (const Vector2d& p : positions) all.push_back({p, 0.0, static_cast<int>(all.size()) + 1});
    return all;
  };
  std::vector<Neighbours> swarms{
      {},
      at({{200, 0}}),
      at({{0, 0}}),
      at({{0, 0}, {0, 0}}),
      at({{100, 0}, {-100, 0}}),
      at({{100, 100}, {200, 200}, {300, 300}}),
      at({{50, 0}, {50, 0}, {50, 0}}),
      at({{1e-12, 0}, {0, 1e-12}}),
      at({{1e-300, 0}, {-1e-300, 1e-300}}),
      at({{649.9999, 0}, {650, 0}, {650.0001, 0}}),
      at({{1e7, 0}, {0, -1e7}}),
  };
  swarms.push_back(heard(square_lattice(4, 3, 5.0), 0));
  Neighbours crowd;
  for (int i = 0; i < 40; ++i) crowd.push_back({{7.0 * i, 3.0 * (i % 5)}, 500.0, anonymous});
  swarms.push_back(crowd);  // more than the plan has slots
  return swarms;
}

::testing::AssertionResult finite(const Target& target) {
  if (target.position.allFinite() && std::isfinite(target.cost) &&
      target.force_m_s2.value_or(Vector2d::Zero()).allFinite()) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << target.position.transpose() << ", cost " << target.cost;
}

TEST_P(EveryBehaviour, AnswersEveryDegenerateSwarmWithAFiniteTarget) {
  const Plan plan = square_lattice(4, 3, 300.0);
  for (const Neighbours& swarm : degenerate_swarms()) {
    for (const Neighbours& seen : {swarm, without_ids(swarm)}) {
      const Target target = made->step({seen, 0}, plan);
      EXPECT_TRUE(finite(target)) << seen.size() << " neighbours";
      if (target.held()) {
        EXPECT_EQ(target.position, Vector2d(0, 0)) << name_of(target.reason);
      }
    }
  }
}

TEST_P(EveryBehaviour, AnswersEverySwarmWithAFiniteTargetAndTwiceWithTheSame) {
  EXPECT_TRUE(rc::check("finite, and the same again, with and without ids", [&] {
    const Plan plan = drawn_plan(1, 12);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours identified = drawn_neighbours(plan, own);
    for (const Neighbours& seen : {identified, without_ids(identified)}) {
      const Target target = made->step({seen, own}, plan);
      RC_ASSERT(target.position.allFinite() && std::isfinite(target.cost));
      const Target again = made->step({seen, own}, plan);
      RC_ASSERT(again.position == target.position);
      RC_ASSERT(again.cost == target.cost);
      RC_ASSERT(again.reason == target.reason);
    }
  }));
}

TEST_P(EveryBehaviour, HoldsWithAReasonWhenItHearsNoVehicleAndHasNowhereToGo) {
  const Target target = made->step({{}, 3}, square_lattice(4, 3, 300.0));
  if (made->needs_waypoint()) {
    EXPECT_EQ(target.reason, Reason::placed);
    return;
  }
  EXPECT_EQ(target.reason, Reason::no_neighbour);
  EXPECT_EQ(target.position, Vector2d(0, 0));
}

TEST_P(EveryBehaviour, HoldsAmongStrangersIfAndOnlyIfItNeedsIds) {
  const Plan plan = square_lattice(3, 3, 300.0);
  const Neighbours strangers = without_ids(heard(plan, 4, {}, {20, 10}));
  const Target target = made->step({strangers, 4}, plan);
  EXPECT_EQ(target.held(), made->needs_ids());
}

TEST_P(EveryBehaviour, GivesTwoThreadsTheSameBits) {
  const Plan plan = square_lattice(4, 3, 300.0);
  const auto fly = [&](std::vector<Target>& targets) {
    for (int own = 0; own < plan.size(); ++own) {
      const Vector2d displaced(11.0 + own, -7.0 * own);
      const Neighbours seen = heard(plan, own, rotation(0.3 * own), displaced);
      targets.push_back(made->step({seen, own}, plan));
    }
  };
  std::array<std::vector<Target>, 2> targets;
  {
    std::thread other(fly, std::ref(targets[1]));
    fly(targets[0]);
    other.join();
  }
  ASSERT_EQ(targets[0].size(), targets[1].size());
  for (std::size_t i = 0; i < targets[0].size(); ++i) {
    EXPECT_EQ(targets[0][i].position, targets[1][i].position);
    EXPECT_EQ(targets[0][i].cost, targets[1][i].cost);
  }
}

INSTANTIATE_TEST_SUITE_P(Behaviours, EveryBehaviour,
                         testing::ValuesIn(Registry<Behaviour>::instance().names()),
                         [](const auto& tested) { return shoal::tests::test_name(tested.param); });

TEST(Behaviours, HaveTheNamesOfTheThesis) {
  for (const char* name : {"attraction_repulsion", "pairwise_referencing", "rigid_registration",
                           "assignment_registration"}) {
    EXPECT_NO_THROW(behaviour(name)) << name;
  }
}

}  // namespace
}  // namespace shoal::formations
