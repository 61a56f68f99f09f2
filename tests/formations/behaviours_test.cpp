// What holds for every registered behaviour: a new one is tested by being there.

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "shoal/formations/conformance.hpp"
#include "tests/formations/swarm.hpp"
#include "tests/support/test_name.hpp"

namespace shoal::formations {
namespace {

using namespace tests;

class EveryBehaviour : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Behaviour> made = behaviour(GetParam());
};

TEST_P(EveryBehaviour, HoldsWhatEveryBehaviourHolds) {
  // Rotations are searched by steps that divide a quarter turn.
  EXPECT_EQ(violations(*made, {.turn_step_deg = 90.0}), std::vector<std::string>{});
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
