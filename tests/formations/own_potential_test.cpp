// The researcher's example of README.md: a cost of one's own is one file with one enrolment line.

#include <gtest/gtest.h>

#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/potential.hpp"

namespace shoal::formations {
namespace {

/// A spring between two vehicles: (r - s)^2 / 2, in square metres.
struct Spring {
  double stiffness = 1.0;

  template <class T>
  T operator()(const T& r, double s) const {  // r, s in metres
    return 0.5 * stiffness * (r - s) * (r - s);
  }

  static void declare(Options<Spring>& o) {
    o.number("stiffness", &Spring::stiffness, "", above(0), "pull per metre of stretch");
  }
};

const EnrolPotential<Spring> enrolled{"spring", "a spring"};

TEST(OwnPotential, IsTakenByABehaviourOnceItIsEnrolled) {
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
