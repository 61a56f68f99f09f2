#include "shoal/formations/behaviours/assignment_registration.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "shoal/formations/behaviour.hpp"
#include "shoal/solvers/matching/matching.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::formations {
namespace {

class ByAssignment final : public Behaviour {
 public:
  explicit ByAssignment(const AssignmentRegistration& options)
      : options_(options),
        matcher_(options.matching.make()),
        registration_(solvers::closed_form()) {}

  bool needs_ids() const override { return false; }
  std::unique_ptr<Memory> new_memory() const override { return matcher_->new_memory(); }

  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan& plan, const Solving& solving) const override {
    thread_local std::vector<Eigen::Vector2d> points;
    collect(seen, plan.size(), points);
    if (points.size() < 2) return Target::hold(Reason::no_neighbour);

    const solvers::MatchingProblem problem{points, plan.slots(), options_.ownship_weight};
    const solvers::MatchingSolution match = solving.solve(*matcher_, problem, solving.memory());
    if (!match.usable()) return Target::hold(Reason::solver_failed);
    const Eigen::Vector2d& own_slot = plan.slot(match.slot_of_point[0]);

    thread_local std::vector<solvers::PointPair> pairs;
    pair_up(points, match, plan, pairs);
    const auto fit = solving.solve(*registration_, solvers::RegistrationProblem{pairs});
    if (fit.status != solvers::Status::converged) return Target::hold(Reason::degenerate);
    return Target::at_slot(fit.T_to_from, own_slot, match.cost);
  }

 private:
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

  AssignmentRegistration options_;
  std::shared_ptr<const solvers::Matcher> matcher_;
  std::shared_ptr<const solvers::RegistrationSolver> registration_;
};

const Register<Behaviour, AssignmentRegistration> registered{
    "assignment_registration",
    "which slots are these, by assignment over sampled rotations (Rypkema 2015, sec. 3.7); no ids",
    [](const AssignmentRegistration& options) { return std::make_unique<ByAssignment>(options); }};

}  // namespace

void AssignmentRegistration::declare(Options<AssignmentRegistration>& o) {
  using A = AssignmentRegistration;
  o.number("contact_rangeout_m", &A::contact_rangeout_m, "m", above(0),
           "neighbours further away are ignored (Rypkema 2015, Table 3.7)");
  o.number("ownship_weight", &A::ownship_weight, "", in(0, 1e3),
           "weight of the own position; the author's trials ran with 1");
  o.choice("matching", &A::matching, "finds slots and rotation");
}

}  // namespace shoal::formations
