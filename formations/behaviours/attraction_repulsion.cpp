#include <boost/container/small_vector.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/cohesion.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/formations/selection.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {
namespace {

/// Sum (or mean) of a pair potential over the selected neighbours, and a cohesion term: Rypkema
/// 2015, eq. 3.7. Unknowns: the own position (m, own frame).
///
/// A value that holds its places itself; the potential and the cohesion belong to the behaviour.
class AttractionRepulsionCost final : public solvers::Objective {
 public:
  const Potential* potential = nullptr;
  const Cohesion* cohesion = nullptr;
  double separation_m = 0.0;
  double share = 1.0;  // of each selected neighbour: 1 for a sum, 1/n for a mean
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();
  boost::container::small_vector<Eigen::Vector2d, 8> selected;

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    const Eigen::Vector2d p(x[0], x[1]);
    auto [cost, slope, curvature] = cohesion->at(p - anchor);

    for (const Eigen::Vector2d& neighbour : selected) {
      const Eigen::Vector2d away = p - neighbour;
      const double r = away.norm();
      // On top of a neighbour the potential has no gradient; the solver must turn away from it.
      if (!(r > 0.0)) return std::numeric_limits<double>::infinity();
      if (!gradient && !hessian) {
        cost += share * potential->value(r, separation_m);
        continue;
      }
      const RadialValue f = potential->derivatives(r, separation_m);
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

enum class Combination { sum, mean };

struct AttractionRepulsionOptions {
  double contact_rangeout_m = 650.0;
  double separation_m = 300.0;
  Combination combination = Combination::sum;
  Choice<Selection> selection{"two_neighbours"};
  Choice<Cohesion> cohesion{"centroid"};
  Choice<Potential> potential{"thesis"};
  Choice<solvers::Solver> solver{"newton"};

  static void declare(Options<AttractionRepulsionOptions>& o) {
    using A = AttractionRepulsionOptions;
    o.number("contact_rangeout_m", &A::contact_rangeout_m, "m", above(0),
             "neighbours further away are ignored (Rypkema 2015, Table 3.4)");
    o.number("separation_m", &A::separation_m, "m", above(0), "distance of lattice neighbours");
    o.word("combination", &A::combination, {{"sum", Combination::sum}, {"mean", Combination::mean}},
           "of the potentials: their sum (eq. 3.7) or their mean (the author's program)");
    o.choice("selection", &A::selection, "neighbours that the vehicle goes by");
    o.choice("cohesion", &A::cohesion, "term against fracture");
    o.choice("potential", &A::potential, "pair potential");
    o.choice("solver", &A::solver, "minimises the cost");
  }
};

/// Refuses what was chosen, where that or its options were written.
template <class Family>
[[noreturn]] void refuse(const Choice<Family>& choice, const std::string& why) {
  const ChoiceSetting& setting = choice.setting();
  const std::string path = setting.path.empty() ? Family::family : setting.path;
  throw InputError(setting.options().origin, path + "." + choice.kind() + ": " + why);
}

/// Goes to the nearest minimum of an attraction/repulsion potential of some neighbours: Rypkema
/// 2015, sec. 3.4, Alg. 5. Needs neither ids nor a plan.
class AttractionRepulsion final : public Behaviour {
 public:
  explicit AttractionRepulsion(const AttractionRepulsionOptions& options)
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
    const Neighbour somebody{{options.separation_m, 0.0}};
    const solvers::Problem usual(Eigen::Vector2d::Zero(), cost_of({&somebody, 1}, {}));
    if (const auto why = solver_->refuses(usual)) {
      refuse(options.solver, *why + "; choose a solver for two unknowns without bounds");
    }
  }

  bool needs_ids() const override { return false; }

  Target step(const Neighbourhood& seen, const Plan&) const override {
    const auto problem = problem_of(seen);
    if (!problem) return Target::hold(Reason::no_neighbour);
    const solvers::Solution solution = solver_->solve(*problem);
    if (!solution.usable()) return Target::hold(Reason::solver_failed);
    return Target::at(solution.x.head<2>(), solution.cost);
  }

  void pose(const Neighbourhood& seen, const Plan&, ProblemViewer& viewer) const override {
    if (const auto problem = problem_of(seen)) viewer.see(*problem);
  }

 private:
  /// The problem of a vehicle, valid as long as this behaviour; nothing if nobody is in range.
  std::optional<solvers::Problem> problem_of(const Neighbourhood& seen) const {
    thread_local std::vector<Neighbour> in_range;
    in_range.clear();
    for (const Neighbour& n : seen.neighbours) {
      if (n.position.norm() <= options_.contact_rangeout_m) in_range.push_back(n);
    }
    const AttractionRepulsionCost cost = cost_of(in_range, seen.own.position);
    if (cost.selected.empty()) return std::nullopt;
    return std::optional<solvers::Problem>(std::in_place, Eigen::Vector2d::Zero(), cost);
  }

  AttractionRepulsionCost cost_of(std::span<const Neighbour> in_range,
                                  const Eigen::Vector2d& own_position) const {
    thread_local std::vector<int> chosen;
    selection_->select(in_range, chosen);
    AttractionRepulsionCost cost;
    for (const int i : chosen) {
      cost.selected.push_back(in_range[static_cast<std::size_t>(i)].position);
    }
    if (chosen.empty()) return cost;
    cost.potential = potential_.get();
    cost.cohesion = cohesion_.get();
    cost.separation_m = options_.separation_m;
    if (options_.combination == Combination::mean) {
      cost.share = 1.0 / static_cast<double>(chosen.size());
    }
    cost.anchor = cohesion_->anchor(in_range, own_position);
    return cost;
  }

  AttractionRepulsionOptions options_;
  std::shared_ptr<const Selection> selection_;
  std::shared_ptr<const Cohesion> cohesion_;
  std::shared_ptr<const Potential> potential_;
  std::shared_ptr<const solvers::Solver> solver_;
};

const Enrol<Behaviour, AttractionRepulsionOptions> enrolled{
    "attraction_repulsion",
    "nearest minimum of a pair potential of some neighbours (Rypkema 2015, sec. 3.4); no ids",
    [](const AttractionRepulsionOptions& options) {
      return std::make_unique<AttractionRepulsion>(options);
    }};

}  // namespace
}  // namespace shoal::formations
