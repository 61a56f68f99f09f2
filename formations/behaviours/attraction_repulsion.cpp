#include <cmath>
#include <limits>
#include <memory>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/potential.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {
namespace {

/// Sum (or mean) of a pair potential over the selected neighbours, and the pull of a centroid:
/// Rypkema 2015, eq. 3.7. Unknowns: the own position (m, own frame).
class AttractionRepulsionCost final : public solvers::Objective {
 public:
  const Potential* potential = nullptr;
  double separation_m = 0.0;
  double share = 1.0;  // of each selected neighbour: 1 for a sum, 1/n for a mean
  Eigen::Vector2d selected[2];
  int count = 0;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();
  double centroid_weight = 0.0;

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    const Eigen::Vector2d p(x[0], x[1]);
    const Eigen::Vector2d from_centroid = p - centroid;
    double cost = centroid_weight * from_centroid.squaredNorm();
    Eigen::Vector2d slope = 2.0 * centroid_weight * from_centroid;
    Eigen::Matrix2d curvature = 2.0 * centroid_weight * Eigen::Matrix2d::Identity();

    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d away = p - selected[i];
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
    if (sizeof(*this) <= size) return {new (storage) AttractionRepulsionCost(*this), false};
    return {new AttractionRepulsionCost(*this), true};
  }
};

enum class Combination { sum, mean };
enum class Centroid { neighbours, neighbours_and_own };

struct AttractionRepulsionOptions {
  double contact_rangeout_m = 650.0;
  double separation_m = 300.0;
  double centroid_weight = 1e-5;
  Combination combination = Combination::sum;
  Centroid centroid = Centroid::neighbours;
  Choice<Potential> potential{"thesis"};
  Choice<solvers::Solver> solver{"nlopt.lbfgs"};

  static void declare(Options<AttractionRepulsionOptions>& o) {
    using A = AttractionRepulsionOptions;
    o.number("contact_rangeout_m", &A::contact_rangeout_m, "m", above(0),
             "neighbours further away are ignored (Rypkema 2015, Table 3.4)");
    o.number("separation_m", &A::separation_m, "m", above(0), "distance of lattice neighbours");
    o.number("centroid_weight", &A::centroid_weight, "1/m", at_least(0),
             "pull towards the centroid of all neighbours, against fracture (eq. 3.7)");
    o.word("combination", &A::combination, {{"sum", Combination::sum}, {"mean", Combination::mean}},
           "of the two potentials: their sum (eq. 3.7) or their mean (the author's program)");
    o.word("centroid", &A::centroid,
           {{"neighbours", Centroid::neighbours},
            {"neighbours_and_own", Centroid::neighbours_and_own}},
           "of the neighbours (eq. 3.7), or with the own position counted (the author's program)");
    o.choice("potential", &A::potential, "pair potential");
    o.choice("solver", &A::solver, "minimises the cost");
  }
};

/// Goes to the nearest minimum of an attraction/repulsion potential of two neighbours: Rypkema
/// 2015, sec. 3.4, Alg. 5. Needs neither ids nor a plan.
class AttractionRepulsion final : public Behaviour {
 public:
  explicit AttractionRepulsion(const AttractionRepulsionOptions& options)
      : options_(options), potential_(options.potential.make()), solver_(options.solver.make()) {}

  bool needs_ids() const override { return false; }

  Target step(const Neighbourhood& seen, const Plan&) const override {
    AttractionRepulsionCost cost;
    if (!select(seen, cost)) return Target::hold(Reason::no_neighbour);
    cost.potential = potential_.get();
    cost.separation_m = options_.separation_m;
    cost.share = options_.combination == Combination::sum ? 1.0 : 1.0 / cost.count;
    cost.centroid_weight = options_.centroid_weight;

    const solvers::Problem problem(Eigen::Vector2d::Zero(), cost);
    const solvers::Solution solution = solver_->solve(problem);
    if (!solution.usable()) return Target::hold(Reason::solver_failed);
    return Target::at(solution.x.head<2>(), solution.cost);
  }

 private:
  // The nearest neighbour, and the one that makes the triangle with it and the vehicle shortest
  // (Lee and Chong; Rypkema 2015, Alg. 5, lines 6-23).
  bool select(const Neighbourhood& seen, AttractionRepulsionCost& cost) const {
    const auto usable = [&](const Neighbour& n) {
      return n.position.norm() <= options_.contact_rangeout_m;
    };
    const Neighbour* nearest = nullptr;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int heard = 0;
    for (const Neighbour& n : seen.neighbours) {
      if (!usable(n)) continue;
      sum += n.position;
      ++heard;
      if (!nearest || n.position.norm() < nearest->position.norm()) nearest = &n;
    }
    if (!nearest) return false;
    const int own = options_.centroid == Centroid::neighbours_and_own ? 1 : 0;
    cost.centroid = sum / (heard + own);
    cost.selected[cost.count++] = nearest->position;

    const Neighbour* second = nullptr;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Neighbour& n : seen.neighbours) {
      if (&n == nearest || !usable(n)) continue;
      const double sides = n.position.norm() + (n.position - nearest->position).norm();
      if (sides < shortest) {
        shortest = sides;
        second = &n;
      }
    }
    if (second) cost.selected[cost.count++] = second->position;
    return true;
  }

  AttractionRepulsionOptions options_;
  std::shared_ptr<const Potential> potential_;
  std::shared_ptr<const solvers::Solver> solver_;
};

const Enrol<Behaviour, AttractionRepulsionOptions> enrolled{
    "attraction_repulsion",
    "nearest minimum of a pair potential of two neighbours (Rypkema 2015, sec. 3.4); no ids",
    [](const AttractionRepulsionOptions& options) {
      return std::make_unique<AttractionRepulsion>(options);
    }};

}  // namespace
}  // namespace shoal::formations
