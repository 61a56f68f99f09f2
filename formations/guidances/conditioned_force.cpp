#include "shoal/formations/guidances/conditioned_force.hpp"

namespace shoal::formations {

void ConditionedForceOptions::declare(Options<ConditionedForceOptions>& o) {
  using C = ConditionedForceOptions;
  o.number("period_s", &C::period_s, "s", above(0),
           "how often the command is renewed, and the time in which it is to be reached");
  o.table("envelope", &C::envelope, "what is asked for at most");
}

ConditionedForce::ConditionedForce(const ConditionedForceOptions& options) : options_(options) {
  if (const auto wrong = options.envelope.complaint()) throw InputError("envelope: " + *wrong);
}

Command ConditionedForce::command(const Target& target, const Eigen::Vector2d&, const OwnState& own,
                                  Memory*) const {
  if (!target.force_m_s2) return {};
  return commanded(*target.force_m_s2, own, options_.period_s, options_.envelope);
}

namespace {

const Register<Guidance, ConditionedForceOptions> registered{
    "conditioned_force",
    "what an envelope of speeds and turns allows of a force (Barisic et al. 2011, sec. 5.4)",
    [](const ConditionedForceOptions& options) {
      return std::make_unique<ConditionedForce>(options);
    }};

}  // namespace
}  // namespace shoal::formations
