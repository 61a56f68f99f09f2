// The researcher's second example of README.md: examples/nearest.cpp.

#include <gtest/gtest.h>

#include "shoal/formations/selection.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

TEST(OwnSelection, IsTakenByABehaviourOnceItIsRegistered) {
  const auto made = tests::behaviour("attraction_repulsion",
                                     {{"selection.kind", "nearest"}, {"cohesion.kind", "none"}});
  const std::vector<Neighbour> heard{{{500, 0}}, {{0, 320}}};
  const Target target = made->step({heard, 0}, tests::plan_of({{0, 0}}));
  EXPECT_LT((target.position - Eigen::Vector2d(0, 20)).norm(), 0.01);
}

}  // namespace
}  // namespace shoal::formations
