#include "shoal/formations/behaviours/pairwise_referencing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/fitting.hpp"
#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;

/// How far the vehicle is from the places that pairs imply. Unknowns: its position (m, own frame).
class DistanceFromPlaces final : public solvers::VectorFunction {
 public:
  explicit DistanceFromPlaces(std::vector<Vector2d> places) : places_(std::move(places)) {}

  int blocks() const override { return static_cast<int>(places_.size()); }
  int block_size() const override { return 2; }

  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    const Vector2d& place = places_[static_cast<std::size_t>(block)];
    Eigen::Map<Vector2d>{values} = Eigen::Map<const Vector2d>(x) - place;
    if (jacobian) Eigen::Map<Eigen::Matrix2d>(jacobian).setIdentity();
    if (hessians) std::fill_n(hessians, 8, 0.0);
  }

 private:
  std::vector<Vector2d> places_;
};

class ByPairs final : public Behaviour {
 public:
  explicit ByPairs(const PairwiseReferencing& options)
      : options_(options), loss_(options.loss.make()), solver_(options.solver.make()) {
    if (loss_->is_square()) return;
    const ChoiceSetting& loss = options.loss.setting();
    if (options.normalisation == Normalisation::count) {
      require_nothing_against(
          "does not go with normalisation = \"count\", which shrinks a mean; choose normalisation "
          "= \"weights\", or the loss least_squares",
          "loss", loss, loss);
    }
    if (auto why = solver_->refuses(problem_of({{0.0, 0.0}}, {1.0}))) {
      require_nothing_against(*why + "; choose another solver", "solver", options.solver.setting(),
                              loss);
    }
  }

  bool needs_ids() const override { return true; }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    return loss_->is_square() ? step_to_mean(seen, plan, solving)
                              : step_to_least_cost(seen, plan, solving);
  }

 private:
  struct Heard {
    int identified = 0;  // neighbours
    int in_range = 0;    // pairs
    int placed = 0;      // pairs with a direction
    double weight = 0.0;
  };

  Target step_to_mean(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const {
    Vector2d sum = Vector2d::Zero();
    const Heard heard = visit_places(
        seen, plan, [&](const Vector2d& place, double weight) { sum += weight * place; });
    if (const auto why = nothing_to_go_by(heard)) return Target::hold(*why);
    if (heard.weight > 0.0) solving.closed_form([&] { return mean_of_problem(seen, plan); });
    const bool by_weights = options_.normalisation == Normalisation::weights;
    return Target::at(sum / (by_weights ? heard.weight : heard.placed), 0.0);
  }

  /// The least squares that the mean solves; the shrinking by normalisation = "count" comes after.
  std::pair<solvers::Problem, solvers::Solution> mean_of_problem(const Neighbourhood& seen,
                                                                 const Plan& plan) const {
    const auto problem = std::get<solvers::Problem>(problem_of(seen, plan));
    solvers::Solution mean;
    mean.x = problem.start;
    mean.cost = problem.evaluate(problem.start.data());
    mean.status = solvers::Status::converged;
    mean.backend_says = "closed form";
    return {problem, mean};
  }

  Target step_to_least_cost(const Neighbourhood& seen, const Plan& plan,
                            const Solving& solving) const {
    const auto posed = problem_of(seen, plan);
    if (const Reason* why = std::get_if<Reason>(&posed)) return Target::hold(*why);
    const solvers::Solution solution = solving.solve(*solver_, std::get<solvers::Problem>(posed));
    if (!solution.usable()) return Target::hold(Reason::solver_failed);
    return Target::at(solution.x.head<2>(), solution.cost);
  }

  std::variant<solvers::Problem, Reason> problem_of(const Neighbourhood& seen,
                                                    const Plan& plan) const {
    std::vector<Vector2d> places;
    std::vector<double> weights;
    const Heard heard = visit_places(seen, plan, [&](const Vector2d& place, double weight) {
      places.push_back(place);
      weights.push_back(weight);
    });
    if (const auto why = nothing_to_go_by(heard)) return *why;
    if (!(heard.weight > 0.0)) return Reason::degenerate;
    return problem_of(std::move(places), std::move(weights));
  }

  /// The sum of weight * loss(|x - place|^2).
  solvers::Problem problem_of(std::vector<Vector2d> places, std::vector<double> weights) const {
    const Vector2d start = start_among(places, weights);
    return solvers::least_squares_problem(
        start,
        {std::make_shared<const DistanceFromPlaces>(std::move(places)), loss_, std::move(weights)});
  }

  /// The mean, or, for robust costs, which have several minima and may be flat far away, the
  /// cheapest of the mean and up to 256 places (of more, 256 that are evenly spread over them). Of
  /// places that cost the same, as those do that no other agrees with, the nearest to the mean.
  Vector2d start_among(const std::vector<Vector2d>& places,
                       const std::vector<double>& weights) const {
    Vector2d mean = Vector2d::Zero();
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      mean += weights[i] * places[i];
      sum += weights[i];
    }
    mean /= sum;
    if (loss_->is_square()) return mean;

    const auto cost = [&](const Vector2d& x) {
      double total = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        total += weights[i] * loss_->at((x - places[i]).squaredNorm()).value;
      }
      return total;
    };
    constexpr double rounding = 1e-12;
    Vector2d start = mean;
    double least = cost(mean);
    const std::size_t count = std::min<std::size_t>(places.size(), 256);
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d& place = places[k * places.size() / count];
      const double there = cost(place);
      const bool tied = std::abs(there - least) <= rounding * least;
      const bool nearer = (place - mean).squaredNorm() < (start - mean).squaredNorm();
      if (!(tied ? nearer : there < least)) continue;
      least = there;
      start = place;
    }
    return start;
  }

  /// Calls visit(place, weight) for every pair of identified neighbours in range.
  template <class Visit>
  Heard visit_places(const Neighbourhood& seen, const Plan& plan, Visit visit) const {
    const Vector2d& own_slot = plan.slot(seen.own_slot);
    const Weights weights = Weights::of(options_);
    Heard heard;
    for (std::size_t i = 0; i < seen.neighbours.size(); ++i) {
      const Neighbour& a = seen.neighbours[i];
      if (a.slot == anonymous) continue;
      ++heard.identified;
      for (std::size_t j = i + 1; j < seen.neighbours.size(); ++j) {
        const Neighbour& b = seen.neighbours[j];
        if (b.slot == anonymous) continue;
        const Vector2d midpoint = 0.5 * (a.position + b.position);
        if (!weights.in_range(midpoint)) continue;
        ++heard.in_range;

        // The rotation from the planned to the actual direction of the pair.
        const Vector2d planned = plan.slot(b.slot) - plan.slot(a.slot);
        const Vector2d actual = b.position - a.position;
        const double lengths = std::sqrt(planned.squaredNorm() * actual.squaredNorm());
        if (!(lengths > 0.0)) continue;  // coincident neighbours have no direction
        const double cosine = planned.dot(actual) / lengths;
        const double sine = (planned.x() * actual.y() - planned.y() * actual.x()) / lengths;

        const Vector2d offset = own_slot - 0.5 * (plan.slot(a.slot) + plan.slot(b.slot));
        const Vector2d place{midpoint.x() + cosine * offset.x() - sine * offset.y(),
                             midpoint.y() + sine * offset.x() + cosine * offset.y()};
        const double weight = weights.weight(midpoint, 0.5 * (a.age_s + b.age_s));
        visit(place, weight);
        heard.weight += weight;
        ++heard.placed;
      }
    }
    return heard;
  }

  std::optional<Reason> nothing_to_go_by(const Heard& heard) const {
    if (heard.identified == 0) return Reason::no_neighbour;
    if (heard.identified == 1) return Reason::one_neighbour;
    if (heard.in_range == 0) return Reason::no_neighbour;
    const bool by_weights = options_.normalisation == Normalisation::weights;
    if (!((by_weights ? heard.weight : heard.placed) > 0.0)) return Reason::degenerate;
    return std::nullopt;
  }

  PairwiseReferencing options_;
  std::shared_ptr<const solvers::Loss> loss_;
  std::shared_ptr<const solvers::Solver> solver_;
};

const Register<Behaviour, PairwiseReferencing> registered{
    "pairwise_referencing",
    "mean of the places that each pair of identified neighbours implies (Rypkema 2015, sec. 3.5)",
    [](const PairwiseReferencing& options) { return std::make_unique<ByPairs>(options); }};

}  // namespace

void PairwiseReferencing::declare(Options<PairwiseReferencing>& o) {
  using P = PairwiseReferencing;
  o.number("contact_rangeout_m", &P::contact_rangeout_m, "m", above(0),
           "pairs whose midpoint is further away are ignored");
  declare_weighting(o,
                    "weight of a pair: nearness of its midpoint (Alg. 6), or freshness of its "
                    "pings (the author's program)");
  o.word("normalisation", &P::normalisation,
         {{"weights", Normalisation::weights}, {"count", Normalisation::count}},
         "divide by the sum of weights (Alg. 6), or by the number of pairs (the author's "
         "program: the target shrinks towards the vehicle as pings age)");
  o.choice("loss", &P::loss, "what the distance from the place that a pair implies costs");
  o.choice("solver", &P::solver,
           "minimises the cost; the loss least_squares has a closed form, the mean");
}

}  // namespace shoal::formations
