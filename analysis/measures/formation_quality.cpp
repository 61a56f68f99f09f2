#include "shoal/analysis/measures/formation_quality.hpp"

#include <algorithm>
#include <numeric>

#include "shoal/solvers/registration/registration.hpp"

namespace shoal::analysis {
namespace {

using Alignment = scenarios::QualityOptions::Alignment;

Eigen::Vector2d centre_of(std::span<const Eigen::Vector2d> points, Alignment alignment) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d::Zero().eval());
  const Eigen::Vector2d centroid = sum / static_cast<double>(points.size());
  if (alignment == Alignment::centroid) return centroid;
  return *std::ranges::min_element(
      points, {}, [&](const Eigen::Vector2d& p) { return (p - centroid).squaredNorm(); });
}

}  // namespace

FormationQuality::FormationQuality(const formations::Plan& plan, Alignment alignment,
                                   double delta_theta_deg)
    : alignment_(alignment),
      turns_(delta_theta_deg),
      slots_(plan.slots().begin(), plan.slots().end()),
      aligned_(plan.slots(), centre_of(plan.slots(), alignment)) {}

double FormationQuality::of(std::span<const Eigen::Vector2d> positions) {
  const Eigen::Vector2d centre = centre_of(positions, alignment_);
  centred_.clear();
  for (const Eigen::Vector2d& p : positions) centred_.push_back(p - centre);

  search_.set_points(centred_);
  search_.match(turns_, aligned_, last_turn_);
  const double limit = search_.cost() + solvers::cost_tie_m;
  const solvers::TurnedMatch best = search_.search(turns_, aligned_, limit);
  last_turn_ = best.turn;
  search_.match(turns_, aligned_, best.turn);

  const std::span<const int> slot_of = search_.slot_of_point();
  solvers::Procrustes registration;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    registration.add(slots_[static_cast<std::size_t>(slot_of[i])], positions[i], 1.0);
  }
  const Transform2 T_world_plan = registration.solve().T_to_from;
  double sum = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sum += (T_world_plan * slots_[static_cast<std::size_t>(slot_of[i])] - positions[i]).norm();
  }
  return sum / static_cast<double>(positions.size());
}

}  // namespace shoal::analysis
