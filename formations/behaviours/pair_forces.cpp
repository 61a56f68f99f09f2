#include "shoal/formations/behaviours/pair_forces.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/lattice.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"

namespace shoal::formations {
namespace {

class AsParticle final : public Behaviour {
 public:
  explicit AsParticle(const PairForces& options)
      : options_(options), selection_(options.selection.make()) {
    std::unique_ptr<Potential> potential = options.potential.make();
    if (const auto why = potential->complaint(options.separation_m)) {
      const ChoiceSetting& setting = options.potential.setting();
      const std::string path = setting.path.empty() ? Potential::family : setting.path;
      throw InputError(setting.options().origin, path + "." + setting.kind + ": " + *why);
    }
    potential->prepare(options.separation_m);
    potential_ = std::move(potential);
  }

  bool needs_ids() const override { return options_.lattice == Lattice::squares; }
  bool needs_clock() const override { return true; }
  bool gives_forces() const override { return true; }

  /// The cost is the potential of the neighbours, in metres. Its force is a gradient, not the
  /// answer to a problem.
  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
    thread_local std::vector<Neighbour> in_range;
    thread_local std::vector<int> chosen;
    in_range.clear();
    for (const Neighbour& n : seen.neighbours) {
      if (needs_ids() && n.slot == anonymous) continue;
      if (n.position.norm() <= options_.contact_rangeout_m) in_range.push_back(n);
    }
    selection_->select(in_range, chosen);
    if (chosen.empty()) return Target::hold(Reason::no_neighbour);

    double potential = 0.0;
    Eigen::Vector2d force = -options_.friction_per_s * seen.own.velocity;
    for (const int i : chosen) {
      const Neighbour& n = in_range[static_cast<std::size_t>(i)];
      const double r = n.position.norm();
      if (!(r > 0.0)) return Target::hold(Reason::degenerate);
      const bool like = needs_ids() && alike(n.slot, seen.own_slot);
      const RadialValue f = like ? derivatives_of_like(*potential_, r, options_.separation_m)
                                 : potential_->derivatives(r, options_.separation_m);
      potential += f.value;
      force += options_.strength_m_s2 * f.slope / r * n.position;
    }
    if (!force.allFinite() || !std::isfinite(potential)) return Target::hold(Reason::solver_failed);
    return Target::push(force, potential);
  }

 private:
  PairForces options_;
  std::shared_ptr<const Selection> selection_;
  std::shared_ptr<const Potential> potential_;
};

const Register<Behaviour, PairForces> registered{
    "pair_forces",
    "forces of a pair potential of some neighbours, with friction (Spears et al. 2004)",
    [](const PairForces& options) { return std::make_unique<AsParticle>(options); }};

}  // namespace

void PairForces::declare(Options<PairForces>& o) {
  using P = PairForces;
  o.number("contact_rangeout_m", &P::contact_rangeout_m, "m", above(0),
           "vehicles further away are not felt: 1.5 separations in Spears et al. 2004, 1.7 for "
           "squares");
  o.number("separation_m", &P::separation_m, "m", above(0), "distance of lattice neighbours");
  o.word("lattice", &P::lattice, {{"triangles", Lattice::triangles}, {"squares", Lattice::squares}},
         "of all vehicles alike, or of two kinds by the parity of their slots, which needs ids "
         "(Spears et al. 2004)");
  o.number("strength_m_s2", &P::strength_m_s2, "m/s2", above(0),
           "acceleration where the potential has a slope of 1");
  o.number("friction_per_s", &P::friction_per_s, "1/s", at_least(0),
           "deceleration per own velocity; 0 conserves the energy of a closed swarm");
  o.choice("selection", &P::selection, "neighbours whose forces the vehicle feels");
  o.choice("potential", &P::potential, "pair potential, whose negative slope is the force");
}

}  // namespace shoal::formations
