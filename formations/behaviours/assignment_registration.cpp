#include <algorithm>
#include <memory>
#include <vector>

#include "shoal/core/angles.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {
namespace {

struct AssignmentRegistrationOptions {
  double contact_rangeout_m = 650.0;
  double ownship_weight = 0.1;
  double delta_theta_deg = 45.0;
  Choice<solvers::Matcher> matching{"sampled"};

  static void declare(Options<AssignmentRegistrationOptions>& o) {
    using A = AssignmentRegistrationOptions;
    o.number("contact_rangeout_m", &A::contact_rangeout_m, "m", above(0),
             "neighbours further away are ignored (Rypkema 2015, Table 3.7)");
    o.number("ownship_weight", &A::ownship_weight, "", in(0, 1e3),
             "weight of the own position; the author's trials ran with 1");
    o.number("delta_theta_deg", &A::delta_theta_deg, "deg", in(solvers::least_delta_theta_deg, 180),
             "step of the search over rotations; the thesis used 45 without currents, 10 in them");
    o.choice("matching", &A::matching, "finds slots and rotation");
  }
};

/// Finds out which slots the vehicle and its neighbours take, moves the plan onto them, and goes to
/// the slot found for the vehicle: Rypkema 2015, sec. 3.7, Alg. 8. Needs no ids.
class AssignmentRegistration final : public Behaviour {
 public:
  explicit AssignmentRegistration(const AssignmentRegistrationOptions& options)
      : options_(options), matcher_(options.matching.make()) {}

  bool needs_ids() const override { return false; }

  Target step(const Neighbourhood& seen, const Plan& plan) const override {
    thread_local std::vector<Eigen::Vector2d> points;
    collect(seen, plan.size(), points);
    if (points.size() < 2) return Target::hold(Reason::no_neighbour);

    const solvers::MatchingSolution match = matcher_->solve(matching(points, plan, seen.own_slot));
    if (!match.usable()) return Target::hold(Reason::solver_failed);

    thread_local std::vector<solvers::PointPair> pairs;
    pair_up(points, match, plan, pairs);
    solvers::Procrustes registration;
    for (const solvers::PointPair& p : pairs) registration.add(p.from, p.to, p.weight);
    const solvers::RegistrationSolution fit = registration.solve();
    if (fit.status != solvers::RegistrationStatus::fitted) return Target::hold(Reason::degenerate);
    return Target::at_slot(fit.T_to_from, plan.slot(match.slot_of_point[0]), match.cost);
  }

  void pose(const Neighbourhood& seen, const Plan& plan, ProblemViewer& viewer) const override {
    std::vector<Eigen::Vector2d> points;
    collect(seen, plan.size(), points);
    if (points.size() < 2) return;
    viewer.see(matching(points, plan));
    const solvers::MatchingSolution match = matcher_->solve(matching(points, plan));
    if (!match.usable()) return;
    std::vector<solvers::PointPair> pairs;
    pair_up(points, match, plan, pairs);
    viewer.see(solvers::RegistrationProblem{pairs});
  }

 private:
  solvers::MatchingProblem matching(std::span<const Eigen::Vector2d> points, const Plan& plan,
                                    int asker = -1) const {
    return {points, plan.slots(), options_.ownship_weight, options_.delta_theta_deg, asker};
  }

  void pair_up(std::span<const Eigen::Vector2d> points, const solvers::MatchingSolution& match,
               const Plan& plan, std::vector<solvers::PointPair>& pairs) const {
    pairs.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double weight = i == 0 ? options_.ownship_weight : 1.0;
      if (weight > 0.0) pairs.push_back({plan.slot(match.slot_of_point[i]), points[i], weight});
    }
  }

  // The own position, then the neighbours in range. A plan of N slots has room for N - 1
  // neighbours; if more are heard (tracks of vehicles that have gone), the nearest count.
  void collect(const Neighbourhood& seen, int slots, std::vector<Eigen::Vector2d>& points) const {
    points.assign(1, Eigen::Vector2d::Zero());
    for (const Neighbour& n : seen.neighbours) {
      if (n.position.norm() <= options_.contact_rangeout_m) points.push_back(n.position);
    }
    if (points.size() <= static_cast<std::size_t>(slots)) return;
    std::stable_sort(points.begin() + 1, points.end(),
                     [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
    points.resize(static_cast<std::size_t>(slots));
  }

  AssignmentRegistrationOptions options_;
  std::shared_ptr<const solvers::Matcher> matcher_;
};

const Enrol<Behaviour, AssignmentRegistrationOptions> enrolled{
    "assignment_registration",
    "which slots are these, by assignment over sampled rotations (Rypkema 2015, sec. 3.7); no ids",
    [](const AssignmentRegistrationOptions& options) {
      return std::make_unique<AssignmentRegistration>(options);
    }};

}  // namespace
}  // namespace shoal::formations
