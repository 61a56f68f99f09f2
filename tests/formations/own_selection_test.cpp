// The researcher's second example of README.md: a neighbour selection of one's own.

#include <gtest/gtest.h>

#include <algorithm>

#include "shoal/formations/selection.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

/// The nearest neighbour only.
struct Nearest : Selection {
  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.clear();
    const auto distance = [](const Neighbour& n) { return n.position.norm(); };
    const auto nearest = std::ranges::min_element(in_range, {}, distance);
    if (nearest != in_range.end()) chosen.push_back(static_cast<int>(nearest - in_range.begin()));
  }

  static void declare(Options<Nearest>&) {}
};
const Enrol<Selection, Nearest> enrolled{"nearest", "the nearest neighbour only"};

TEST(OwnSelection, IsTakenByABehaviourOnceItIsEnrolled) {
  const auto made = tests::behaviour("attraction_repulsion",
                                     {{"selection.kind", "nearest"}, {"cohesion.kind", "none"}});
  const std::vector<Neighbour> heard{{{500, 0}}, {{0, 320}}};
  const Target target = made->step({heard, 0}, tests::plan_of({{0, 0}}));
  EXPECT_LT((target.position - Eigen::Vector2d(0, 20)).norm(), 0.01);
}

}  // namespace
}  // namespace shoal::formations
