#include "shoal/formations/behaviours/virtual_potential.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/fields/virtual_potential.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {
namespace {

Eigen::Vector2d ahead(const OwnState& own, double lead_s) {
  return own.position + lead_s * own.velocity;
}

/// The others as the potential takes them: their places in the frame of the own positions.
///
/// The heading of a neighbour that does not tell it is taken as east, along x.
std::span<const Agent> agents_in_range(const Neighbourhood& seen, double range_m, double lead_s) {
  thread_local std::vector<Agent> agents;
  agents.clear();
  for (const Neighbour& n : seen.neighbours) {
    if (n.position.norm() > range_m) continue;
    agents.push_back({seen.own.position + n.position + lead_s * n.velocity, n.heading_rad});
  }
  return agents;
}

class DownThePotential final : public Behaviour {
 public:
  explicit DownThePotential(const VirtualPotentialForce& options) : options_(options) {}

  bool needs_ids() const override { return false; }
  bool needs_waypoint() const override { return true; }
  bool needs_clock() const override { return true; }
  bool gives_forces() const override { return true; }

  /// Its force is a gradient, not the answer to a problem.
  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
    const VirtualPotential potential(options_.gains, seen.waypoint, seen.obstacles);
    const auto others = agents_in_range(seen, options_.contact_rangeout_m, options_.lead_s);
    const Eigen::Vector2d place = ahead(seen.own, options_.lead_s);
    const Eigen::Vector2d force = potential.force(place, seen.own.velocity, others);
    const double cost = potential.potential(place, others).value;
    if (!force.allFinite() || !std::isfinite(cost)) return Target::hold(Reason::solver_failed);
    return Target::push(force, cost);
  }

 private:
  VirtualPotentialForce options_;
};

class ToMinimumWithinReach final : public Behaviour {
 public:
  explicit ToMinimumWithinReach(const VirtualPotentialStep& options)
      : options_(options), solver_(options.solver.make()) {
    const VirtualPotential open(options.gains, Eigen::Vector2d::UnitX(), {});
    if (const auto why = solver_->refuses(problem(open, {}, {}))) {
      const ChoiceSetting& setting = options.solver.setting();
      const std::string path = setting.path.empty() ? "solver" : setting.path;
      throw InputError(setting.options().origin,
                       path + "." + options.solver.kind() + ": " + *why +
                           "; choose a solver for two unknowns with bounds");
    }
  }

  bool needs_ids() const override { return false; }
  bool needs_waypoint() const override { return true; }
  bool needs_clock() const override { return true; }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan&, const Solving& solving) const override {
    const VirtualPotential potential(options_.gains, seen.waypoint, seen.obstacles);
    const auto others = agents_in_range(seen, options_.contact_rangeout_m, options_.lead_s);
    const solvers::Solution solution =
        solving.solve(*solver_, problem(potential, seen.own, others));
    if (!solution.usable()) return Target::hold(Reason::solver_failed);
    return Target::at(solution.x.head<2>(), solution.cost);
  }

 private:
  solvers::Problem problem(const VirtualPotential& potential, const OwnState& own,
                           std::span<const Agent> others) const {
    solvers::Problem posed(Eigen::Vector2d::Zero(),
                           VirtualPotentialCost(potential, ahead(own, options_.lead_s), others));
    posed.lower = Eigen::Vector2d::Constant(-options_.reach_m);
    posed.upper = Eigen::Vector2d::Constant(options_.reach_m);
    return posed;
  }

  VirtualPotentialStep options_;
  std::shared_ptr<const solvers::Solver> solver_;
};

/// The options that both have.
template <class Made>
void declare_potential(Options<Made>& o) {
  o.number("contact_rangeout_m", &Made::contact_rangeout_m, "m", above(0),
           "vehicles further away are ignored");
  o.number("lead_s", &Made::lead_s, "s", at_least(0),
           "forces are those of where all vehicles will be so much later if they go on as they do. "
           "A hull's course follows its rudder by some seconds, and a force that comes late feeds "
           "oscillations in the cell; a lead of that time damps them");
  o.table("gains", &Made::gains, "strengths and reaches of the potentials");
}

const Register<Behaviour, VirtualPotentialForce> force{
    "virtual_potential",
    "force of a waypoint, obstacles, rotors and formation cells (Barisic et al. 2011); no ids",
    [](const VirtualPotentialForce& options) {
      return std::make_unique<DownThePotential>(options);
    }};

const Register<Behaviour, VirtualPotentialStep> step{
    "virtual_potential_step", "minimum within reach of the same potential, by a solver; no ids",
    [](const VirtualPotentialStep& options) {
      return std::make_unique<ToMinimumWithinReach>(options);
    }};

}  // namespace

void VirtualPotentialForce::declare(Options<VirtualPotentialForce>& o) {
  declare_potential(o);
}

void VirtualPotentialStep::declare(Options<VirtualPotentialStep>& o) {
  using S = VirtualPotentialStep;
  declare_potential(o);
  o.number("reach_m", &S::reach_m, "m", above(0), "no further east, north, west or south");
  o.choice("solver", &S::solver, "minimises the potential within reach");
}

}  // namespace shoal::formations
