#include "shoal/formations/behaviour.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {
namespace {

/// Moves the plan rigidly onto what was heard and goes to the own slot: Rypkema 2015, sec. 3.6,
/// eq. 3.8, Alg. 7, Table 3.6. Needs ids.
class RigidRegistration final : public Behaviour {
 public:
  double contact_rangeout_m = 650.0;
  double ownship_weight = 1.0;

  static void declare(Options<RigidRegistration>& o) {
    using R = RigidRegistration;
    o.number("contact_rangeout_m", &R::contact_rangeout_m, "m", above(0),
             "neighbours further away are ignored");
    o.number("ownship_weight", &R::ownship_weight, "", in(0, 1e3),
             "weight of the own position; the lower, the closer the plan follows the neighbours");
  }

  bool needs_ids() const override { return true; }

  Target step(const Neighbourhood& seen, const Plan& plan) const override {
    solvers::Procrustes registration;
    const Eigen::Vector2d& own_slot = plan.slot(seen.own_slot);
    if (ownship_weight > 0.0) {
      registration.add(own_slot, Eigen::Vector2d::Zero(), ownship_weight);
    }
    bool heard = false;
    for (const Neighbour& n : seen.neighbours) {
      if (n.slot == anonymous || n.position.norm() > contact_rangeout_m) continue;
      registration.add(plan.slot(n.slot), n.position, 1.0);
      heard = true;
    }
    if (!heard) return Target::hold(Reason::no_neighbour);

    const solvers::RegistrationSolution fit = registration.solve();
    if (fit.status != solvers::RegistrationStatus::fitted) return Target::hold(Reason::degenerate);
    return Target::at(fit.T_to_from * own_slot, fit.cost);
  }
};

const Enrol<Behaviour, RigidRegistration> enrolled{
    "rigid_registration",
    "rigid motion of the plan onto the identified neighbours (Rypkema 2015, sec. 3.6)"};

}  // namespace
}  // namespace shoal::formations
