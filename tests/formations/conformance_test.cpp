// Behaviours that are each wrong in one way: violations() finds it, and nothing else.

#include "shoal/formations/conformance.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/formations/swarm.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;

/// Goes to the mean of its neighbours, but for what a test changes.
struct Towards final : Behaviour {
  std::function<Vector2d(const Neighbourhood&, const Plan&)> place;
  bool ids = false;
  Vector2d off_together = Vector2d::Zero();

  bool needs_ids() const override { return ids; }
  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving&) const override {
    if (seen.neighbours.empty()) return Target::hold(Reason::no_neighbour);
    if (ids && seen.neighbours.front().slot == anonymous) {
      return Target::hold(Reason::no_neighbour);
    }
    return Target::at(place(seen, plan), 0.0);
  }
  void step_together(std::span<const Neighbourhood> seen, const Plan& plan,
                     std::span<const Solving> solving, std::span<Target> targets) const override {
    Behaviour::step_together(seen, plan, solving, targets);
    targets.back().position += off_together;
  }
};

/// The rules that it breaks, without their examples.
std::string broken_by(const Behaviour& behaviour) {
  std::string rules;
  for (const std::string& found : violations(behaviour)) {
    rules += (rules.empty() ? "" : " | ") + found.substr(0, found.find("; "));
  }
  return rules;
}

Vector2d mean(const Neighbourhood& seen) {
  Vector2d sum = Vector2d::Zero();
  for (const Neighbour& n : seen.neighbours) sum += n.position;
  return sum / static_cast<double>(seen.neighbours.size());
}

Towards towards(std::function<Vector2d(const Neighbourhood&, const Plan&)> place) {
  Towards behaviour;
  behaviour.place = std::move(place);
  return behaviour;
}

TEST(Conformance, FindsNothingWrongWithTheMean) {
  EXPECT_EQ(broken_by(towards([](const auto& seen, const Plan&) { return mean(seen); })), "");
}

TEST(Conformance, FindsADirectionOfTheWorld) {
  EXPECT_EQ(broken_by(towards([](const auto& seen, const Plan&) {
              return Vector2d(mean(seen) + Vector2d(1.0, 0.0));
            })),
            "the orientation of the frame means nothing");
}

TEST(Conformance, FindsAPlaceOfTheWorld) {
  const std::string found = broken_by(towards([](const auto& seen, const Plan&) {
    return Vector2d(mean(seen) - 0.01 * seen.own.position);
  }));
  EXPECT_EQ(found, "the origin of the frame means nothing");
}

TEST(Conformance, FindsAPreferredNeighbour) {
  EXPECT_EQ(broken_by(towards(
                [](const auto& seen, const Plan&) { return seen.neighbours.front().position; })),
            "the order of the neighbours means nothing");
}

TEST(Conformance, FindsAPreferredSlot) {
  Towards by_number = towards([](const Neighbourhood& seen, const Plan&) {
    Vector2d sum = Vector2d::Zero();
    for (const Neighbour& n : seen.neighbours) sum += n.slot * n.position;
    return sum;
  });
  by_number.ids = true;
  EXPECT_EQ(broken_by(by_number), "the numbers of the slots mean nothing");
}

TEST(Conformance, FindsThatThePlanWasTakenForAPlace) {
  Towards by_plan = towards([](const Neighbourhood& seen, const Plan& plan) {
    const double share = plan.slot(seen.own_slot).norm() / 1e4;
    return Vector2d(share * mean(seen));
  });
  EXPECT_EQ(broken_by(by_plan), "the frame of the plan means nothing");
}

TEST(Conformance, FindsATargetThatIsNotFinite) {
  EXPECT_EQ(broken_by(towards([](const auto& seen, const Plan&) {
              const Vector2d to = mean(seen);
              return Vector2d(to / to.norm());
            })),
            "targets and costs are finite");
}

TEST(Conformance, FindsWhatChangesFromCallToCall) {
  int calls = 0;
  const std::string found = broken_by(towards([&](const auto& seen, const Plan&) {
    return Vector2d(mean(seen) * (1.0 + 1e-9 * ++calls));
  }));
  EXPECT_EQ(found, "the same neighbours give the same bits");
}

TEST(Conformance, FindsIdsThatWereNotDeclared) {
  struct Strict final : Behaviour {
    bool needs_ids() const override { return false; }
    using Behaviour::step;
    Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
      return seen.neighbours.empty() ? Target::hold(Reason::no_neighbour)
                                     : Target::hold(Reason::degenerate);
    }
  };
  EXPECT_EQ(broken_by(Strict()),
            "among strangers a vehicle holds if and only if the behaviour needs ids");
}

TEST(Conformance, FindsThatAVehicleAloneGoesSomewhere) {
  struct Restless final : Behaviour {
    bool needs_ids() const override { return false; }
    using Behaviour::step;
    Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
      return Target::at(seen.neighbours.empty() ? Vector2d(1, 0) : mean(seen), 0.0);
    }
  };
  EXPECT_EQ(broken_by(Restless()), "a vehicle that hears no other holds, for that reason");
}

TEST(Conformance, FindsOtherTargetsForSeveralVehiclesTogether) {
  Towards mixed = towards([](const auto& seen, const Plan&) { return mean(seen); });
  mixed.off_together = {1.0, 0.0};
  EXPECT_EQ(broken_by(mixed), "several vehicles together get what each gets alone");
}

TEST(Conformance, TakesTurnsUpToAQuarter) {
  const Towards fine = towards([](const auto& seen, const Plan&) { return mean(seen); });
  EXPECT_EQ(shoal::tests::complaint_of([&] { violations(fine, {.turn_step_deg = 0.0}); }),
            "turn_step_deg is 0; it takes a number above 0 and at most 90");
}

}  // namespace
}  // namespace shoal::formations
