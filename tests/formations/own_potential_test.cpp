// The researcher's example of README.md, examples/spring.cpp: a cost of your own is one file.

#include <gtest/gtest.h>

#include <vector>

#include "shoal/formations/behaviour.hpp"

namespace shoal::formations {
namespace {

TEST(OwnPotential, IsTakenByABehaviourOnceItIsRegistered) {
  Setting options;
  assign(options, "potential.kind", {"spring", {}});
  assign(options, "potential.spring.stiffness", {2.0, {}});
  const auto behaviour =
      Registry<Behaviour>::instance().make("attraction_repulsion", options, "behaviour");

  const Plan plan({"a", "b", "c"}, {{0, 0}, {300, 0}, {0, 300}});
  const std::vector<Neighbour> heard{{{300, 0}, 0.0, anonymous}, {{0, 320}, 0.0, anonymous}};
  const Target target = behaviour->step({heard, 0}, plan);
  EXPECT_NEAR((heard[0].position - target.position).norm(), 300.0, 0.1);
  EXPECT_NEAR((heard[1].position - target.position).norm(), 300.0, 0.1);
}

TEST(OwnPotential, HasItsOptionsReadAndRefusedLikeAnyOther) {
  Setting options;
  assign(options, "potential.spring.stiffnes", {2.0, {"swarm.toml", 7}});
  try {
    Registry<Behaviour>::instance().make("attraction_repulsion", options, "behaviour");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "swarm.toml:7: behaviour.potential.spring has no option \"stiffnes\"; did you "
                 "mean \"stiffness\"?");
  }
}

}  // namespace
}  // namespace shoal::formations
