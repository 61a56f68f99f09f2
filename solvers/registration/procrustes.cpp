#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::solvers {

RegistrationSolution Procrustes::solve() const {
  RegistrationSolution solution;
  if (bad_ || !any_) return solution;

  const double share = 1.0 / weight_;
  const Eigen::Vector2d from_mean = share * from_sum_;
  const Eigen::Vector2d to_mean = share * to_sum_;
  const double dot = dot_cross_.x() - from_sum_.dot(to_mean);
  const double cross = dot_cross_.y() - (from_sum_.x() * to_mean.y() - from_sum_.y() * to_mean.x());
  const double from_spread = squared_[0] - from_sum_.dot(from_mean);
  const double to_spread = squared_[1] - to_sum_.dot(to_mean);
  const double squared = dot * dot + cross * cross;
  const double scale_squared = squared_[0] * squared_[1];
  if (!std::isfinite(squared) || !std::isfinite(scale_squared)) return solution;

  // What is left of dot and cross after the means went is rounding, some 1e-15 of the sums.
  // Coincident points leave nothing else, nor do sets whose pairs turn both ways alike.
  constexpr double rounding = 1e-12;
  if (squared > rounding * rounding * scale_squared) {
    const double length = std::sqrt(squared);
    solution.status = Status::converged;
    solution.T_to_from.cosine = dot / length;
    solution.T_to_from.sine = cross / length;
    solution.cost = std::max(0.0, from_spread + to_spread - 2.0 * length);
  } else {
    solution.status = Status::undetermined;
    solution.T_to_from.cosine = 1.0;
    solution.T_to_from.sine = 0.0;
    solution.cost = std::max(0.0, from_spread + to_spread - 2.0 * dot);
  }
  solution.T_to_from.translation =
      to_origin_ + to_mean - solution.T_to_from.rotate(from_origin_ + from_mean);
  return solution;
}

namespace {

class ClosedForm final : public RegistrationSolver {
 public:
  RegistrationSolution solve(const RegistrationProblem& problem) const override {
    if (!problem.is_square()) return {};
    Procrustes sums;
    for (const PointPair& pair : problem.pairs) sums.add(pair.from, pair.to, pair.weight);
    return sums.solve();
  }

  std::optional<std::string> refuses(const RegistrationProblem& problem) const override {
    if (problem.is_square()) return std::nullopt;
    std::vector<std::string> others = Registry<RegistrationSolver>::instance().names();
    std::erase(others, "procrustes");
    return "takes the loss least_squares only; choose one of " + listed(others) +
           " for other losses";
  }

  static void declare(Options<ClosedForm>&) {}
};

const Register<RegistrationSolver, ClosedForm> registered{
    "procrustes", "closed form, for the loss least_squares (Rypkema 2015, eq. 3.8)"};

}  // namespace

std::unique_ptr<RegistrationSolver> closed_form() {
  return std::make_unique<ClosedForm>();
}

}  // namespace shoal::solvers
