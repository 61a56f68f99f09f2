#include <cmath>

#include "shoal/formations/behaviour.hpp"

namespace shoal::formations {
namespace {

/// Places the vehicle with respect to every pair of neighbours as planned, and goes to the mean of
/// these places: Rypkema 2015, sec. 3.5, Alg. 6, Table 3.5. Needs ids.
///
/// Algorithm 6 projects from the actual midpoint by the planned angle alone; without the actual
/// bearing of the pair the target would not turn with the formation (and its sine and cosine are
/// exchanged for mathematical angles). The invariant that fixes both: with the neighbours placed as
/// planned, up to any rotation and translation, the target is exactly the own slot.
class PairwiseReferencing final : public Behaviour {
 public:
  enum class Weighting { distance, ping_age, none };
  enum class Normalisation { weights, count };

  double contact_rangeout_m = 650.0;
  Weighting weighting = Weighting::distance;
  Normalisation normalisation = Normalisation::weights;
  double age_scale_s = 120.0;

  static void declare(Options<PairwiseReferencing>& o) {
    using P = PairwiseReferencing;
    o.number("contact_rangeout_m", &P::contact_rangeout_m, "m", above(0),
             "pairs whose midpoint is further away are ignored");
    o.word("weighting", &P::weighting,
           {{"distance", Weighting::distance},
            {"ping_age", Weighting::ping_age},
            {"none", Weighting::none}},
           "weight of a pair: nearness of its midpoint (Alg. 6), or freshness of its pings (the "
           "author's program)");
    o.word("normalisation", &P::normalisation,
           {{"weights", Normalisation::weights}, {"count", Normalisation::count}},
           "divide by the sum of weights (Alg. 6), or by the number of pairs (the author's "
           "program: the target shrinks towards the vehicle as pings age)");
    o.number("age_scale_s", &P::age_scale_s, "s", above(0),
             "age at which the weight \"ping_age\" has fallen to zero");
  }

  bool needs_ids() const override { return true; }

  Target step(const Neighbourhood& seen, const Plan& plan) const override {
    const Eigen::Vector2d& own_slot = plan.slot(seen.own_slot);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double weights = 0.0;
    int pairs = 0, in_range = 0, identified = 0;

    for (std::size_t i = 0; i < seen.neighbours.size(); ++i) {
      const Neighbour& a = seen.neighbours[i];
      if (a.slot == anonymous) continue;
      ++identified;
      for (std::size_t j = i + 1; j < seen.neighbours.size(); ++j) {
        const Neighbour& b = seen.neighbours[j];
        if (b.slot == anonymous) continue;
        const Eigen::Vector2d midpoint = 0.5 * (a.position + b.position);
        const double distance = midpoint.norm();
        if (distance > contact_rangeout_m) continue;
        ++in_range;

        // The rotation from the planned to the actual direction of the pair.
        const Eigen::Vector2d planned = plan.slot(b.slot) - plan.slot(a.slot);
        const Eigen::Vector2d actual = b.position - a.position;
        const double lengths = std::sqrt(planned.squaredNorm() * actual.squaredNorm());
        if (!(lengths > 0.0)) continue;  // coincident neighbours have no direction
        const double cosine = planned.dot(actual) / lengths;
        const double sine = (planned.x() * actual.y() - planned.y() * actual.x()) / lengths;

        const Eigen::Vector2d offset = own_slot - 0.5 * (plan.slot(a.slot) + plan.slot(b.slot));
        const Eigen::Vector2d place{midpoint.x() + cosine * offset.x() - sine * offset.y(),
                                    midpoint.y() + sine * offset.x() + cosine * offset.y()};
        const double weight = weight_of(distance, 0.5 * (a.age_s + b.age_s));
        sum += weight * place;
        weights += weight;
        ++pairs;
      }
    }
    if (identified < 2) {
      return Target::hold(identified == 0 ? Reason::no_neighbour : Reason::one_neighbour);
    }
    if (in_range == 0) return Target::hold(Reason::no_neighbour);
    const double divisor = normalisation == Normalisation::weights ? weights : pairs;
    if (!(divisor > 0.0)) return Target::hold(Reason::degenerate);
    return Target::at(sum / divisor, 0.0);
  }

 private:
  double weight_of(double midpoint_distance, double age_s) const {
    switch (weighting) {
      case Weighting::distance:
        return 1.0 - midpoint_distance / contact_rangeout_m;
      case Weighting::ping_age:
        return std::max(0.0, 1.0 - age_s / age_scale_s);
      case Weighting::none:
        break;
    }
    return 1.0;
  }
};

const Enrol<Behaviour, PairwiseReferencing> enrolled{
    "pairwise_referencing",
    "mean of the places that each pair of identified neighbours implies (Rypkema 2015, sec. 3.5)"};

}  // namespace
}  // namespace shoal::formations
