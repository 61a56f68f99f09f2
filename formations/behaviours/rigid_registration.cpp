#include "shoal/formations/behaviours/rigid_registration.hpp"

#include <memory>
#include <span>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/fitting.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {
namespace {

class ByRigidMotion final : public Behaviour {
 public:
  explicit ByRigidMotion(const RigidRegistration& options)
      : options_(options), loss_(options.loss.make()), registration_(options.registration.make()) {
    require_nothing_against(registration_->refuses({{}, loss_.get()}), "registration",
                            options.registration.setting(), options.loss.setting());
  }

  bool needs_ids() const override { return true; }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    thread_local std::vector<solvers::PointPair> storage;
    const std::span<const solvers::PointPair> pairs = pairs_of(seen, plan, storage);
    if (pairs.empty()) return Target::hold(Reason::no_neighbour);

    const solvers::RegistrationSolution fit =
        solving.solve(*registration_, solvers::RegistrationProblem{pairs, loss_.get()});
    if (fit.status == solvers::Status::undetermined || fit.status == solvers::Status::bad_input) {
      return Target::hold(Reason::degenerate);
    }
    if (!fit.usable()) return Target::hold(Reason::solver_failed);
    return Target::at_slot(fit.T_to_from, plan.slot(seen.own_slot), fit.cost);
  }

 private:
  /// The slots of the neighbours that were heard, and their places; before them the own slot, if it
  /// counts. Nothing if no neighbour was heard. `storage` only grows.
  std::span<const solvers::PointPair> pairs_of(const Neighbourhood& seen, const Plan& plan,
                                               std::vector<solvers::PointPair>& storage) const {
    const std::size_t most = seen.neighbours.size() + 1;
    if (storage.size() < most) storage.resize(most);
    solvers::PointPair* end = storage.data();
    const bool own_counts = options_.ownship_weight > 0.0;
    if (own_counts) {
      *end++ = {plan.slot(seen.own_slot), Eigen::Vector2d::Zero(), options_.ownship_weight};
    }
    const Weights weights = Weights::of(options_);  // which no pair can alias: stays in registers
    for (const Neighbour& n : seen.neighbours) {
      if (n.slot == anonymous || !weights.in_range(n.position)) continue;
      *end++ = {plan.slot(n.slot), n.position, weights.weight(n.position, n.age_s)};
    }
    const std::span<const solvers::PointPair> pairs{storage.data(), end};
    return pairs.size() > (own_counts ? 1 : 0) ? pairs : std::span<const solvers::PointPair>{};
  }

  RigidRegistration options_;
  std::shared_ptr<const solvers::Loss> loss_;
  std::shared_ptr<const solvers::RegistrationSolver> registration_;
};

const Register<Behaviour, RigidRegistration> registered{
    "rigid_registration",
    "rigid motion of the plan onto the identified neighbours (Rypkema 2015, sec. 3.6)",
    [](const RigidRegistration& options) { return std::make_unique<ByRigidMotion>(options); }};

}  // namespace

void RigidRegistration::declare(Options<RigidRegistration>& o) {
  using R = RigidRegistration;
  o.number("contact_rangeout_m", &R::contact_rangeout_m, "m", above(0),
           "neighbours further away are ignored");
  o.number("ownship_weight", &R::ownship_weight, "", in(0, 1e3),
           "weight of the own position; the lower, the closer the plan follows the neighbours");
  declare_weighting(o,
                    "weight of a neighbour: always 1 (sec. 3.6), its nearness, or the freshness "
                    "of its pings, as pairwise_referencing weighs pairs");
  o.choice("loss", &R::loss, "what the distance of a vehicle from its place in the plan costs");
  o.choice("registration", &R::registration, "finds the motion of the plan");
}

}  // namespace shoal::formations
