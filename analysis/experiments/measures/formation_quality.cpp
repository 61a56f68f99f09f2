#include "shoal/analysis/experiments/measures/formation_quality.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "shoal/solvers/matching/rigid_matching.hpp"
#include "shoal/solvers/matching/rotation_search.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::analysis {
namespace {

using scenarios::QualityOptions;
using Alignment = QualityOptions::Alignment;

Eigen::Vector2d centroid_of(std::span<const Eigen::Vector2d> points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d::Zero().eval());
  return sum / static_cast<double>(points.size());
}

Eigen::Vector2d centre_of(std::span<const Eigen::Vector2d> points, Alignment alignment) {
  const Eigen::Vector2d centroid = centroid_of(points);
  if (alignment == Alignment::centroid) return centroid;
  return *std::ranges::min_element(
      points, {}, [&](const Eigen::Vector2d& p) { return (p - centroid).squaredNorm(); });
}

/// The least of all rigid motions and assignments.
class Rigid final : public FormationQuality::Recipe {
 public:
  Rigid(const formations::Plan& plan, const QualityOptions& options)
      : matching_(plan.slots(), {options.tolerance_m, options.budget}) {}

  FormationQuality::Value of(std::span<const Eigen::Vector2d> positions) override {
    const Eigen::Vector2d centroid = centroid_of(positions);
    // Where the swarm has gone as a whole since then does not matter.
    if (last_) last_->translation -= last_->rotate(centroid - last_centroid_);
    const solvers::RigidMatch match = matching_.match(positions, last_);
    last_ = match.T_slots_points;
    last_centroid_ = centroid;
    return {match.mean_m, match.lower_bound_m};
  }

  std::span<const int> slot_of_position() const override { return matching_.slot_of_point(); }

 private:
  solvers::RigidMatching matching_;
  std::optional<Transform2> last_;  // T_plan_world
  Eigen::Vector2d last_centroid_;
};

/// Two points are laid upon one another and the plan is turned by steps; then the assignment found
/// is registered by least squares.
class Turned final : public FormationQuality::Recipe {
 public:
  Turned(const formations::Plan& plan, const QualityOptions& options)
      : alignment_(options.alignment),
        turns_(options.delta_theta_deg),
        slots_(plan.slots().begin(), plan.slots().end()),
        aligned_(plan.slots(), centre_of(plan.slots(), options.alignment)) {}

  FormationQuality::Value of(std::span<const Eigen::Vector2d> positions) override {
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
    return {sum / static_cast<double>(positions.size()), std::nullopt};
  }

  std::span<const int> slot_of_position() const override { return search_.slot_of_point(); }

 private:
  Alignment alignment_;
  solvers::Turns turns_;
  std::vector<Eigen::Vector2d> slots_;
  solvers::AlignedSlots aligned_;
  solvers::RotationSearch search_;
  std::vector<Eigen::Vector2d> centred_;
  int last_turn_ = 0;  // most likely near the next one: it bounds the search
};

}  // namespace

FormationQuality::FormationQuality(const formations::Plan& plan, const QualityOptions& options) {
  if (options.alignment == Alignment::rigid) {
    recipe_ = std::make_unique<Rigid>(plan, options);
  } else {
    recipe_ = std::make_unique<Turned>(plan, options);
  }
}

}  // namespace shoal::analysis
