#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

struct NewtonOptions : Limits {
  double first_radius_m = 10.0;
  double largest_radius_m = 100.0;

  static void declare(Options<NewtonOptions>& o) {
    declare_limits(o);
    o.number("first_radius_m", &NewtonOptions::first_radius_m, "m", above(0.0),
             "the first step is at most this long");
    o.number("largest_radius_m", &NewtonOptions::largest_radius_m, "m", above(0.0),
             "no step is longer: well below the distance of neighbours, it keeps the way from "
             "leaping over one of them");
  }
  std::optional<std::string> complaint() const {
    if (first_radius_m <= largest_radius_m) return std::nullopt;
    return "first_radius_m must not be above largest_radius_m";
  }
};

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int N>
using Mat = Eigen::Matrix<double, N, N>;

template <int N>
struct Point {
  Vec<N> x;
  double cost = 0.0;
  Vec<N> slope;
  Mat<N> curvature;

  Attempt::Outcome evaluate(Attempt& attempt) {
    return attempt.evaluate(x.data(), cost, slope.data(), curvature.data());
  }
};

/// The lowest point of slope . p + p . curvature p / 2 within the radius: Moré and Sorensen 1983,
/// Computing a trust region step, by way of the eigenvalues, which are cheap in two or three
/// unknowns.
template <int N>
Vec<N> lowest_within(const Vec<N>& slope, const Mat<N>& curvature, double radius) {
  const Eigen::LLT<Mat<N>> factor(curvature);
  if (factor.info() == Eigen::Success) {
    const Vec<N> newton = -factor.solve(slope);
    if (newton.squaredNorm() <= radius * radius) return newton;
  }
  const Eigen::SelfAdjointEigenSolver<Mat<N>> eigen(curvature);
  const Vec<N>& bends = eigen.eigenvalues();
  const Vec<N> along = eigen.eigenvectors().transpose() * slope;

  // |p(shift)| falls as the shift grows; it must be found where |p| = radius. Below the least
  // eigenvalue the model has no lowest point.
  const auto step = [&](double shift) { return Vec<N>(-along.array() / (bends.array() + shift)); };
  const double size = std::max(std::abs(bends[0]), std::abs(bends[N - 1]));
  const double floor = std::max(0.0, -bends[0]) + 1e-14 * size;
  double low = floor, high = std::max(floor, slope.norm() / radius - bends[0]);
  if (!(floor > 0.0)) low = std::numeric_limits<double>::min();
  Vec<N> p = step(low);
  if (!(p.norm() > radius)) {
    // The hard case: the slope has no part along the least bend, which leads down all the same.
    const double rest = radius * radius - p.squaredNorm();
    if (bends[0] <= 0.0) p[0] += (along[0] > 0.0 ? -1.0 : 1.0) * std::sqrt(std::max(0.0, rest));
    return eigen.eigenvectors() * p;
  }
  double shift = low;
  for (int i = 0; i < 50; ++i) {
    p = step(shift);
    const double length = p.norm();
    if (std::abs(length - radius) <= 1e-3 * radius) break;
    (length > radius ? low : high) = shift;
    // Newton's method on 1/|p| - 1/radius, which is almost a straight line.
    const double fall = (p.array().square() / (bends.array() + shift)).sum() / length;
    shift += (length - radius) / radius * length / fall;
    if (!(shift > low && shift < high)) shift = 0.5 * (low + high);
  }
  return eigen.eigenvectors() * p;
}

/// A minimum within N free unknowns: a trust region about Newton's method on exact derivatives,
/// with bounds by fixing the unknowns that press against theirs (Bertsekas 1982, Projected Newton
/// methods).
template <int N>
class Descent {
 public:
  Descent(Attempt& attempt, const NewtonOptions& options) : attempt_(attempt), options_(options) {
    if (attempt.bounded()) {
      lower_ = attempt.lower();
      upper_ = attempt.upper();
    }
  }

  Solution run() {
    Point<N> here;
    here.x = attempt_.start();
    if (here.evaluate(attempt_) != Attempt::Outcome::fine) return attempt_.finish(0, "no start");
    double radius = options_.first_radius_m;
    // Shorter trials than this learn nothing from their costs.
    const double shortest = 1e-3 * options_.x_tolerance_m;

    while (radius >= shortest) {
      const Vec<N> step = attempt_.bounded() ? step_inside_bounds(here, radius)
                                             : lowest_within<N>(here.slope, here.curvature, radius);
      const double length = step.norm();
      const double expected = -(here.slope.dot(step) + 0.5 * step.dot(here.curvature * step));
      if (length <= options_.x_tolerance_m && length < 0.9 * radius && !attempt_.bounded()) {
        // A whole Newton step, and the curvature is positive: a minimum is as near as asked.
        return attempt_.finish_converged("Newton's step is within the tolerance");
      }
      if (!(expected > 0.0)) {  // bounds cut the step to one that leads nowhere
        if (!attempt_.bounded()) break;
        radius *= 0.25;
        continue;
      }

      Point<N> there;
      there.x = here.x + step;
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
  // Unknowns at a bound that the slope presses them against stay; the others go as far as theirs.
  Vec<N> step_inside_bounds(const Point<N>& here, double radius) const {
    Vec<N> slope = here.slope;
    Mat<N> curvature = here.curvature;
    bool held[N];
    for (int i = 0; i < N; ++i) {
      held[i] = (here.x[i] <= lower_[i] && slope[i] >= 0.0) ||
                (here.x[i] >= upper_[i] && slope[i] <= 0.0);
      if (!held[i]) continue;
      slope[i] = 0.0;
      curvature.row(i).setZero();
      curvature.col(i).setZero();
      curvature(i, i) = 1.0;
    }
    const Vec<N> step = lowest_within<N>(slope, curvature, radius);
    Vec<N> end = (here.x + step).cwiseMax(lower_).cwiseMin(upper_);
    for (int i = 0; i < N; ++i) {
      if (held[i]) end[i] = here.x[i];
    }
    return end - here.x;
  }

  Attempt& attempt_;
  const NewtonOptions& options_;
  Vec<N> lower_, upper_;
};

class Newton final : public Solver {
 public:
  explicit Newton(const NewtonOptions& options) : options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (const auto why = refuses(problem)) return refused(problem);
    Attempt attempt(problem, options_);
    if (!attempt.open()) return attempt.finish(0, "");
    switch (attempt.unknowns()) {
      case 1:
        return Descent<1>(attempt, options_).run();
      case 2:
        return Descent<2>(attempt, options_).run();
      default:
        return Descent<3>(attempt, options_).run();
    }
  }

  std::optional<std::string> refuses(const Problem& problem) const override {
    if (problem.constraints) return "takes no constraints";
    if (problem.dimension() > 3) return "takes at most three unknowns";
    return std::nullopt;
  }

 private:
  NewtonOptions options_;
};

const Enrol<Solver, NewtonOptions> enrolled{
    "newton", "trust-region Newton on exact derivatives, for up to three unknowns",
    [](const NewtonOptions& options) { return std::make_unique<Newton>(options); }};

}  // namespace
}  // namespace shoal::solvers
