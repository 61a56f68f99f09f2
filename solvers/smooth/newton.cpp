#include "shoal/solvers/smooth/newton.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "shoal/solvers/smooth/attempt.hpp"
#include "shoal/solvers/smooth/minimum.hpp"

namespace shoal::solvers {
namespace {

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int N>
using Mat = Eigen::Matrix<double, N, N>;

template <int N>
struct Point {
  Vec<N> x;
  double cost = 0.0;
  Vec<N> gradient;
  Mat<N> hessian;

  explicit Point(const Vec<N>& place)
      : x(place), gradient(place.size()), hessian(place.size(), place.size()) {}

  Attempt::Outcome evaluate(Attempt& attempt) {
    return attempt.evaluate(x.data(), cost, gradient.data(), hessian.data());
  }
};

/// A step of at most `radius` down the gradient: Newton's where the cost curves upwards. In a
/// direction in which it curves downwards, Newton's step would lead up; there the step goes down
/// the gradient by as much, and not at all if there is no gradient. (The lowest point of the model
/// within the radius, Moré and Sorensen 1983, would leave the gradient for a direction that curves
/// downwards: a vehicle pushed off by a single neighbour would swerve around it.)
template <int N>
Vec<N> step_down(const Vec<N>& gradient, const Mat<N>& hessian, double radius, double shortest) {
  const Eigen::LLT<Mat<N>> factor(hessian);
  if (factor.info() == Eigen::Success) {
    const auto pivots = factor.matrixLLT().diagonal().array().square();
    const Vec<N> newton = -factor.solve(gradient);
    // A curvature that is rounding would make a long step.
    if (pivots.minCoeff() > curvature_of_rounding * pivots.maxCoeff() &&
        newton.squaredNorm() <= radius * radius) {
      return newton;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Mat<N>> eigen(hessian);
  const Vec<N>& eigenvalues = eigen.eigenvalues();
  const Vec<N> along = eigen.eigenvectors().transpose() * gradient;
  const double largest =
      std::max(eigenvalues.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const Vec<N> sizes = eigenvalues.cwiseAbs().cwiseMax(curvature_of_rounding * largest);
  const auto step = [&](double shift) { return Vec<N>(-along.array() / (sizes.array() + shift)); };

  // |p| falls as the shift grows; here no part of it is longer than the radius, and the whole not
  // shorter unless the shift is zero.
  double shift = std::max(0.0, (along.cwiseAbs() / radius - sizes).maxCoeff());
  Vec<N> p = step(shift);
  if (shift == 0.0 && p.norm() <= shortest && eigenvalues[0] < -negligible_curvature * largest) {
    // A saddle or a summit: no gradient, but ways down.
    p.setZero();
    p[0] = along[0] > 0.0 ? -radius : radius;
    return eigen.eigenvectors() * p;
  }
  // Newton's method on 1/|p| - 1/radius, which comes to the shift from below: 1/|p| is concave.
  for (int i = 0; i < 20 && p.norm() > 1.001 * radius; ++i) {
    const double squared = p.squaredNorm(), length = std::sqrt(squared);
    const double fall = (p.array().square() / (sizes.array() + shift)).sum();
    shift += (length - radius) / radius * squared / fall;
    p = step(shift);
  }
  return eigen.eigenvectors() * p;
}

/// A minimum within N free unknowns (or any number, if that is Dynamic): a trust region about
/// Newton's method on exact derivatives, with bounds by fixing the unknowns that press against
/// theirs (Bertsekas 1982, Projected Newton methods).
template <int N>
class Descent {
 public:
  Descent(Attempt& attempt, const Newton& options) : attempt_(attempt), options_(options) {
    if (attempt.bounded()) {
      lower_ = attempt.lower();
      upper_ = attempt.upper();
    }
  }

  Solution run() {
    Point<N> here(attempt_.start());
    if (here.evaluate(attempt_) != Attempt::Outcome::fine) return attempt_.finish(0, "no start");
    double radius = options_.first_radius_m;
    // Shorter trials than this learn nothing from their costs.
    const double shortest = 1e-3 * options_.x_tolerance_m;

    while (radius >= shortest) {
      const Vec<N> step = attempt_.bounded() ? step_inside_bounds(here, radius)
                                             : step_down<N>(here.gradient, here.hessian, radius,
                                                            options_.x_tolerance_m);
      const double length = step.norm();
      const double expected = -(here.gradient.dot(step) + 0.5 * step.dot(here.hessian * step));
      if (length <= options_.x_tolerance_m && length < 0.9 * radius && !attempt_.bounded()) {
        // A whole Newton step, and nothing leads down: a minimum is as near as asked.
        return attempt_.finish_converged("Newton's step is within the tolerance");
      }
      if (!(expected > 0.0)) {  // bounds cut the step to one that leads nowhere
        if (!attempt_.bounded()) break;
        radius *= 0.25;
        continue;
      }

      Point<N> there(here.x + step);
      const Attempt::Outcome outcome = there.evaluate(attempt_);
      if (outcome == Attempt::Outcome::stop) break;
      const double gain = here.cost - there.cost;
      if (outcome != Attempt::Outcome::fine || !(gain > 0.25 * expected)) {
        radius = 0.25 * length;
      } else if (gain > 0.75 * expected && length > 0.9 * radius) {
        radius = std::min(2.0 * radius, options_.largest_radius_m);
      }
      if (outcome != Attempt::Outcome::fine || !(gain > 0.0)) continue;
      here = there;
      if (length <= options_.x_tolerance_m) break;
    }
    return attempt_.finish(0, "the step has become too short");
  }

 private:
  // Unknowns at a bound that the gradient presses them against stay; the others go as far as
  // theirs.
  Vec<N> step_inside_bounds(const Point<N>& here, double radius) const {
    Vec<N> gradient = here.gradient;
    Mat<N> hessian = here.hessian;
    Eigen::Array<bool, N, 1> held(gradient.size());
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      held[i] = (here.x[i] <= lower_[i] && gradient[i] >= 0.0) ||
                (here.x[i] >= upper_[i] && gradient[i] <= 0.0);
      if (!held[i]) continue;
      gradient[i] = 0.0;
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = 1.0;
    }
    const Vec<N> step = step_down<N>(gradient, hessian, radius, options_.x_tolerance_m);
    Vec<N> end = (here.x + step).cwiseMax(lower_).cwiseMin(upper_);
    for (Eigen::Index i = 0; i < gradient.size(); ++i) {
      if (held[i]) end[i] = here.x[i];
    }
    return end - here.x;
  }

  Attempt& attempt_;
  const Newton& options_;
  Vec<N> lower_, upper_;
};

class TrustRegionNewton final : public Solver {
 public:
  explicit TrustRegionNewton(const Newton& options) : options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, Limits::of(options_));
    if (!attempt.open()) return attempt.finish(0, "");
    switch (attempt.unknowns()) {
      case 1:
        return Descent<1>(attempt, options_).run();
      case 2:
        return Descent<2>(attempt, options_).run();
      case 3:
        return Descent<3>(attempt, options_).run();
      default:
        return Descent<Eigen::Dynamic>(attempt, options_).run();
    }
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constrained()) return "takes no constraints";
    return std::nullopt;
  }

 private:
  Newton options_;
};

const Register<Solver, Newton> registered{
    "newton", "trust-region Newton on exact derivatives",
    [](const Newton& options) { return std::make_unique<TrustRegionNewton>(options); }};

}  // namespace

std::optional<std::string> Newton::complaint() const {
  if (first_radius_m <= largest_radius_m) return std::nullopt;
  return "first_radius_m must not be above largest_radius_m";
}

void Newton::declare(Options<Newton>& o) {
  declare_limits(o);
  o.number("first_radius_m", &Newton::first_radius_m, "m", above(0.0),
           "the first step is at most this long");
  o.number("largest_radius_m", &Newton::largest_radius_m, "m", above(0.0),
           "no step is longer: well below the distance of neighbours, it keeps the way from "
           "leaping over one of them");
}

}  // namespace shoal::solvers
