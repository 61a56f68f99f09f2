// What can be chosen by name is a type, too.

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <variant>

#include "shoal/core/text.hpp"
#include "shoal/formations/behaviours/assignment_registration.hpp"
#include "shoal/formations/behaviours/attraction_repulsion.hpp"
#include "shoal/formations/behaviours/rigid_registration.hpp"
#include "shoal/formations/cohesions/waypoint.hpp"
#include "shoal/formations/potentials/lennard_jones.hpp"
#include "shoal/formations/selections/k_nearest.hpp"
#include "shoal/solvers/losses/huber.hpp"
#include "shoal/solvers/matching/sampled.hpp"
#include "shoal/solvers/smooth/nlopt.hpp"

namespace shoal::formations {
namespace {

std::string text_of(const Setting& setting) {
  if (setting.is_table()) {
    std::string text = "{";
    for (const auto& [name, entry] : setting.table()) text += name + "=" + text_of(entry) + ",";
    return text + "}";
  }
  if (const auto* word = std::get_if<std::string>(&setting.value)) return *word;
  if (const auto* number = std::get_if<double>(&setting.value)) return shortest(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&setting.value)) return std::to_string(*whole);
  return std::get<bool>(setting.value) ? "true" : "false";
}

TEST(TypedMembers, AreTheSameAsNamedOnes) {
  const Choice<Behaviour> choice =
      AttractionRepulsion{.separation_m = 200.0,
                          .selection = KNearest(3),
                          .cohesion = TowardsWaypoint(2e-5),
                          .potential = LennardJones{.depth_m = 20.0},
                          .solver = solvers::nlopt::Slsqp{.max_evaluations = 90}};
  const Setting written = choice.setting().write(Registry<Behaviour>::instance());
  Setting named;
  assign(named, "kind", {"attraction_repulsion", {}});
  assign(named, "attraction_repulsion.separation_m", {200.0, {}});
  assign(named, "attraction_repulsion.selection.kind", {"k_nearest", {}});
  assign(named, "attraction_repulsion.selection.k_nearest.k", {std::int64_t{3}, {}});
  assign(named, "attraction_repulsion.cohesion.kind", {"waypoint", {}});
  assign(named, "attraction_repulsion.cohesion.waypoint.weight", {2e-5, {}});
  assign(named, "attraction_repulsion.potential.kind", {"lennard_jones", {}});
  assign(named, "attraction_repulsion.potential.lennard_jones.depth_m", {20.0, {}});
  assign(named, "attraction_repulsion.solver.kind", {"nlopt.slsqp", {}});
  assign(named, "attraction_repulsion.solver.nlopt.slsqp.max_evaluations", {std::int64_t{90}, {}});
  Choice<Behaviour> read{""};
  read.setting().read(Registry<Behaviour>::instance(), named, "behaviour");
  EXPECT_EQ(text_of(written), text_of(read.setting().write(Registry<Behaviour>::instance())));
  EXPECT_NE(choice.make(), nullptr);
}

TEST(TypedMembers, AreHeldToTheRangesOfTheirOptions) {
  EXPECT_THROW(make<Behaviour>(RigidRegistration{.ownship_weight = -1.0}), InputError);
  EXPECT_THROW(make<Behaviour>(RigidRegistration{.loss = solvers::Huber(0.0)}), InputError);
  EXPECT_THROW(
      make<Behaviour>(AssignmentRegistration{.matching = solvers::Sampled{.delta_theta_deg = 0.0}}),
      InputError);
}

// Members with options of one type would differ by their names only.
TEST(TypedMembers, HaveATypeEachInTheirFamily) {
  for (const RegistryBase* family : families()) {
    for (const MemberInfo& member : family->members()) {
      if (member.type) {
        EXPECT_EQ(family->of_type(*member.type).name, member.name) << family->family();
      }
    }
  }
  EXPECT_THROW(Registry<Selection>::instance().of_type(typeid(int)), std::logic_error);
}

}  // namespace
}  // namespace shoal::formations
