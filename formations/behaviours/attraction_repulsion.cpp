#include "shoal/formations/behaviours/attraction_repulsion.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shoal/core/small_vector.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/cohesion.hpp"
#include "shoal/formations/lattice.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {
namespace {

/// Sum (or mean) of a pair potential over the selected neighbours, and a cohesion term: Rypkema
/// 2015, eq. 3.7. Unknowns: the own position (m, own frame).
///
/// Damped, the minimiser is one implicit Euler step of c dp/dt = -grad V (the gradient flow of the
/// surveyed potentials, with friction c): it minimises V(p) + c / (2 dt) |p|^2.
///
/// A value that holds its places itself; the potential and the cohesion belong to the behaviour.
class AttractionRepulsionCost final : public solvers::Objective {
 public:
  const Potential* potential = nullptr;
  const Cohesion* cohesion = nullptr;
  double separation_m = 0.0;
  double share = 1.0;  // of each selected neighbour: 1 for a sum, 1/n for a mean
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();
  double damping_per_m = 0.0;                // c / dt
  SmallVector<Eigen::Vector2d, 8> selected;  // from `alike_from` on: like ones
  std::size_t alike_from = 0;

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    const Eigen::Vector2d p(x[0], x[1]);
    auto [cost, slope, curvature] = cohesion->at(p - anchor);

    if (damping_per_m > 0.0) {
      const PlaneValue damped = squared_distance(0.5 * damping_per_m, p);
      cost += damped.value;
      slope += damped.gradient;
      curvature += damped.hessian;
    }
    for (std::size_t k = 0; k < selected.size(); ++k) {
      const Eigen::Vector2d away = p - selected[k];
      const double r = away.norm();
      // On top of a neighbour the potential has no gradient; the solver must turn away from it.
      if (!(r > 0.0)) return std::numeric_limits<double>::infinity();
      if (!gradient && !hessian) {
        cost += share * (k < alike_from ? potential->value(r, separation_m)
                                        : value_of_like(*potential, r, separation_m));
        continue;
      }
      const RadialValue f = k < alike_from ? potential->derivatives(r, separation_m)
                                           : derivatives_of_like(*potential, r, separation_m);
      const Eigen::Vector2d direction = away / r;
      cost += share * f.value;
      slope += share * f.slope * direction;
      const Eigen::Matrix2d radial = direction * direction.transpose();
      curvature +=
          share * (f.curvature * radial + (f.slope / r) * (Eigen::Matrix2d::Identity() - radial));
    }
    if (gradient) Eigen::Map<Eigen::Vector2d>(gradient, 2) = slope;
    if (hessian) Eigen::Map<Eigen::Matrix2d>(hessian, 2, 2) = curvature;
    return cost;
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return solvers::copied_into(*this, storage, size);
  }
};
// What a Problem holds in place: posing one must not allocate.
static_assert(sizeof(AttractionRepulsionCost) <= 256);

/// Refuses what was chosen, where that or its options were written.
template <class Family>
[[noreturn]] void refuse(const Choice<Family>& choice, const std::string& why) {
  const ChoiceSetting& setting = choice.setting();
  const std::string path = setting.path.empty() ? Family::family : setting.path;
  throw InputError(setting.options().origin, path + "." + choice.kind() + ": " + why);
}

class ToPotentialMinimum final : public Behaviour {
 public:
  explicit ToPotentialMinimum(const AttractionRepulsion& options)
      : options_(options),
        selection_(options.selection.make()),
        cohesion_(options.cohesion.make()),
        solver_(options.solver.make()) {
    std::unique_ptr<Potential> potential = options.potential.make();
    if (const auto why = potential->complaint(options.separation_m)) {
      refuse(options.potential, *why);
    }
    potential->prepare(options.separation_m);
    potential_ = std::move(potential);
    const Neighbour neighbour{{options.separation_m, 0.0}};
    const solvers::Problem usual(Eigen::Vector2d::Zero(), cost_of({&neighbour, 1}, {}));
    if (const auto why = solver_->refuses(usual)) {
      refuse(options.solver, *why + "; choose a solver for two unknowns without bounds");
    }
  }

  bool needs_ids() const override { return options_.lattice == Lattice::squares; }
  bool needs_waypoint() const override { return cohesion_->needs_waypoint(); }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan&, const Solving& solving) const override {
    const auto problem = problem_of(seen);
    if (!problem) return Target::hold(Reason::no_neighbour);
    const solvers::Solution solution = solving.solve(*solver_, *problem);
    if (!solution.usable()) return Target::hold(Reason::solver_failed);
    return Target::at(solution.x.head<2>(), solution.cost);
  }

 private:
  /// The problem of a vehicle, valid as long as this behaviour; nothing if no neighbour is in
  /// range.
  std::optional<solvers::Problem> problem_of(const Neighbourhood& seen) const {
    thread_local std::vector<Neighbour> in_range;
    in_range.clear();
    for (const Neighbour& n : seen.neighbours) {
      if (needs_ids() && n.slot == anonymous) continue;
      if (n.position.norm() <= options_.contact_rangeout_m) in_range.push_back(n);
    }
    const AttractionRepulsionCost cost = cost_of(in_range, seen);
    if (cost.selected.empty()) return std::nullopt;
    return std::optional<solvers::Problem>(std::in_place, Eigen::Vector2d::Zero(), cost);
  }

  AttractionRepulsionCost cost_of(std::span<const Neighbour> in_range,
                                  const Neighbourhood& seen) const {
    thread_local std::vector<int> chosen;
    selection_->select(in_range, chosen);
    AttractionRepulsionCost cost;
    if (chosen.empty()) return cost;
    const auto select = [&](auto fits) {
      for (const int i : chosen) {
        const Neighbour& n = in_range[static_cast<std::size_t>(i)];
        if (fits(n)) cost.selected.push_back(n.position);
      }
    };
    const auto like = [&](const Neighbour& n) {
      return options_.lattice == Lattice::squares && alike(n.slot, seen.own_slot);
    };
    select(std::not_fn(like));
    cost.alike_from = cost.selected.size();
    if (cost.alike_from < chosen.size()) select(like);
    cost.damping_per_m = options_.damping_per_m;
    cost.potential = potential_.get();
    cost.cohesion = cohesion_.get();
    cost.separation_m = options_.separation_m;
    if (options_.combination == Combination::mean) {
      cost.share = 1.0 / static_cast<double>(chosen.size());
    }
    cost.anchor = cohesion_->anchor(in_range, seen.waypoint - seen.own.position);
    return cost;
  }

  AttractionRepulsion options_;
  std::shared_ptr<const Selection> selection_;
  std::shared_ptr<const Cohesion> cohesion_;
  std::shared_ptr<const Potential> potential_;
  std::shared_ptr<const solvers::Solver> solver_;
};

const Register<Behaviour, AttractionRepulsion> registered{
    "attraction_repulsion",
    "nearest minimum of a pair potential of some neighbours (Rypkema 2015, sec. 3.4); no ids",
    [](const AttractionRepulsion& options) {
      return std::make_unique<ToPotentialMinimum>(options);
    }};

}  // namespace

void AttractionRepulsion::declare(Options<AttractionRepulsion>& o) {
  using A = AttractionRepulsion;
  o.number("contact_rangeout_m", &A::contact_rangeout_m, "m", above(0),
           "neighbours further away are ignored (Rypkema 2015, Table 3.4)");
  o.number("separation_m", &A::separation_m, "m", above(0), "distance of lattice neighbours");
  o.word("lattice", &A::lattice, {{"triangles", Lattice::triangles}, {"squares", Lattice::squares}},
         "of all vehicles alike, or of two kinds by the parity of their slots, which needs ids "
         "(Spears et al. 2004); for squares a range between sqrt(2) and 2 separations, and all "
         "in range");
  o.word("combination", &A::combination, {{"sum", Combination::sum}, {"mean", Combination::mean}},
         "of the potentials: their sum (eq. 3.7) or their mean (the author's program)");
  o.number("damping_per_m", &A::damping_per_m, "1/m", at_least(0),
           "friction over the time of a step: shortens the way to the minimum (0: all of it)");
  o.choice("selection", &A::selection, "neighbours that the vehicle goes by");
  o.choice("cohesion", &A::cohesion, "term against fracture");
  o.choice("potential", &A::potential, "pair potential");
  o.choice("solver", &A::solver, "minimises the cost");
}

}  // namespace shoal::formations
