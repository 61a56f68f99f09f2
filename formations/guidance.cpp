#include "shoal/formations/guidance.hpp"

namespace shoal::formations {

std::string guidance_for(bool forces) {
  const auto& registry = Registry<Guidance>::instance();
  for (const MemberInfo& member : registry.members()) {
    if (registry.make(member.name, {}, member.name)->takes_forces() == forces) return member.name;
  }
  throw InputError(std::string("no guidance takes ") + (forces ? "forces" : "places"));
}

}  // namespace shoal::formations
