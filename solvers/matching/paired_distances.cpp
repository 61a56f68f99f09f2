#include "shoal/solvers/matching/paired_distances.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shoal::solvers {
namespace {

// Distances are sqrt(d^2 + softening^2) in the descent, which has then a second derivative
// everywhere; what that costs is below any tolerance of interest.
constexpr double least_softening_m = 1e-4;
constexpr int most_steps = 100;
constexpr std::size_t most_sines = 256;

Eigen::Vector2d turned(const Eigen::Vector2d& p, double cosine, double sine) {
  return {cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()};
}

double softened(const Eigen::Vector2d& r, double softening_m) {
  return std::sqrt(r.squaredNorm() + softening_m * softening_m);
}

}  // namespace

/// By (radius * angle, x, y), all in metres.
struct PairedDistances::Derivatives {
  double sum = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

double PairedDistances::Sine::least_on(double angle, double half_width) const {
  const double amplitude = std::hypot(cosine, sine);
  const double here = cosine * std::cos(angle) + sine * std::sin(angle);
  const bool trough_inside =
      half_width >= std::numbers::pi || -here >= amplitude * std::cos(half_width);
  if (trough_inside) return -amplitude - offset;
  const auto at = [this](double a) { return cosine * std::cos(a) + sine * std::sin(a); };
  return std::min(at(angle - half_width), at(angle + half_width)) - offset;
}

void PairedDistances::set(std::span<const Eigen::Vector2d> points,
                          std::span<const Eigen::Vector2d> targets) {
  points_ = points;
  targets_ = targets;
  double squared = 0.0;
  for (const Eigen::Vector2d& p : points) squared += p.squaredNorm();
  radius_ = std::sqrt(squared / static_cast<double>(points.size()));
  if (!(radius_ > least_softening_m)) radius_ = 1.0;
}

double PairedDistances::sum(const RigidPose& pose) const {
  const double cosine = std::cos(pose.angle), sine = std::sin(pose.angle);
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    sum += (turned(points_[i], cosine, sine) + pose.place - targets_[i]).norm();
  }
  work_ += static_cast<std::int64_t>(points_.size());
  return sum;
}

double PairedDistances::softened_sum(const RigidPose& pose, double softening_m) {
  const double cosine = std::cos(pose.angle), sine = std::sin(pose.angle);
  double sum = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    sum += softened(turned(points_[i], cosine, sine) + pose.place - targets_[i], softening_m);
  }
  work_ += static_cast<std::int64_t>(points_.size());
  return sum;
}

PairedDistances::Derivatives PairedDistances::derivatives(const RigidPose& pose, bool turning,
                                                          double softening_m) {
  const double cosine = std::cos(pose.angle), sine = std::sin(pose.angle);
  Derivatives d;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d arm = turned(points_[i], cosine, sine) / radius_;
    const Eigen::Vector2d r = radius_ * arm + pose.place - targets_[i];
    const double distance = softened(r, softening_m), share = 1.0 / distance;
    const Eigen::Vector2d y = share * r;
    const Eigen::Vector2d along(-arm.y(), arm.x());
    const double y_along = turning ? y.dot(along) : 0.0;
    d.sum += distance;
    d.gradient += Eigen::Vector3d(y_along, y.x(), y.y());
    d.hessian(1, 1) += share * (1.0 - y.x() * y.x());
    d.hessian(2, 2) += share * (1.0 - y.y() * y.y());
    d.hessian(2, 1) -= share * y.x() * y.y();
    if (!turning) continue;
    d.hessian(0, 0) += share * (along.squaredNorm() - y_along * y_along) - y.dot(arm) / radius_;
    d.hessian(1, 0) += share * (along.x() - y_along * y.x());
    d.hessian(2, 0) += share * (along.y() - y_along * y.y());
  }
  if (!turning) d.hessian(0, 0) = 1.0;
  work_ += static_cast<std::int64_t>(points_.size());
  return d;
}

// The softer the distances, the farther Newton's method sees; what it leads to is the start with
// harder ones.
RigidPose PairedDistances::descended(RigidPose pose, bool turning) {
  double softening_m = 0.1 * sum(pose) / static_cast<double>(points_.size());
  while (softening_m > least_softening_m) {
    pose = descended(pose, turning, softening_m, 1e-3 * softening_m);
    softening_m *= 0.1;
  }
  return descended(pose, turning, least_softening_m, 1e-13 * (least_softening_m + sum(pose)));
}

// Newton's method, damped as by Levenberg and Marquardt where that does not descend.
RigidPose PairedDistances::descended(RigidPose pose, bool turning, double softening_m,
                                     double least_gain) {
  constexpr double most_damping = 1e12;
  double damping = 0.0;
  Derivatives d = derivatives(pose, turning, softening_m);
  for (int step = 0; step < most_steps && damping < most_damping; ++step) {
    const double scale = d.hessian.trace();
    const Eigen::Matrix3d damped = d.hessian + damping * scale * Eigen::Matrix3d::Identity();
    const Eigen::LLT<Eigen::Matrix3d> factors(damped);  // of the lower triangle
    bool descends = factors.info() == Eigen::Success;
    if (descends) {
      const Eigen::Vector3d move = -factors.solve(d.gradient);
      const double gain = -d.gradient.dot(move);
      if (!(gain > least_gain)) return pose;
      const RigidPose next{pose.angle + move[0] / radius_, pose.place + move.tail<2>()};
      descends = softened_sum(next, softening_m) < d.sum;
      if (descends) {
        pose = next;
        d = derivatives(pose, turning, softening_m);
        damping = damping > 1e-6 ? 0.1 * damping : 0.0;
      }
    }
    if (!descends) damping = std::max(10.0 * damping, 1e-4);
  }
  return pose;
}

PairedDistances::Sine PairedDistances::bound_at(const RigidPose& pose) {
  const double cosine = std::cos(pose.angle), sine = std::sin(pose.angle);
  duals_.clear();
  Eigen::Vector2d rest = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d r = turned(points_[i], cosine, sine) + pose.place - targets_[i];
    duals_.emplace_back(r / softened(r, least_softening_m));
    rest += duals_.back();
  }
  // The descent leaves a small rest of the sum, most of it from a pair that is laid upon one
  // another, where the distance has its kink. That pair takes it, if it can: shared by all, it
  // would make the longest too long, and all of them would have to shrink.
  double longest = 1.0;
  const auto shortest = std::ranges::min_element(
      duals_, {}, [](const Eigen::Vector2d& y) { return y.squaredNorm(); });
  if ((*shortest - rest).norm() <= 1.0) {
    *shortest -= rest;
  } else {
    for (Eigen::Vector2d& y : duals_) {
      y -= rest / static_cast<double>(points_.size());
      longest = std::max(longest, y.norm());
    }
  }
  Sine bound{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d y = duals_[i] / longest;
    bound.cosine += y.dot(points_[i]);
    bound.sine += y.y() * points_[i].x() - y.x() * points_[i].y();
    bound.offset += y.dot(targets_[i]);
  }
  work_ += static_cast<std::int64_t>(points_.size());
  return bound;
}

double PairedDistances::bound_on(double angle, double half_width) const {
  double bound = 0.0;
  for (const Sine& sine : sines_) bound = std::max(bound, sine.least_on(angle, half_width));
  return bound;
}

PairedDistances::Least PairedDistances::least(const RigidPose& start, double slack) {
  Least best;
  best.pose = descended(start, true);
  best.sum = sum(best.pose);
  best.bound_below = std::numeric_limits<double>::infinity();
  sines_.assign(1, bound_at(best.pose));

  struct Arc {
    double angle, half_width;
  };
  std::vector<Arc> open;
  for (const double quarter : {0.25, 0.75, 1.25, 1.75}) {
    open.push_back({best.pose.angle + quarter * std::numbers::pi, 0.25 * std::numbers::pi});
  }
  while (!open.empty()) {
    const Arc arc = open.back();
    open.pop_back();
    double bound = bound_on(arc.angle, arc.half_width);
    if (bound < best.sum - slack && sines_.size() < most_sines) {
      const RigidPose middle = descended({arc.angle, best.pose.place}, false);
      if (const double here = sum(middle); here < best.sum) {
        best.pose = descended(middle, true);
        best.sum = std::min(here, sum(best.pose));
        sines_.push_back(bound_at(best.pose));
      }
      sines_.push_back(bound_at(middle));
      bound = bound_on(arc.angle, arc.half_width);
      if (bound < best.sum - slack) {
        const double half = 0.5 * arc.half_width;
        open.push_back({arc.angle - half, half});
        open.push_back({arc.angle + half, half});
        continue;
      }
    }
    best.bound_below = std::min(best.bound_below, bound);
  }
  best.bound_below = std::min(best.bound_below, best.sum);
  return best;
}

}  // namespace shoal::solvers
