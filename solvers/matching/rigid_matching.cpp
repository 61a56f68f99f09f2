#include "shoal/solvers/matching/rigid_matching.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "shoal/solvers/matching/points.hpp"
#include "shoal/solvers/matching/slot_lattice.hpp"

namespace shoal::solvers {
namespace {

// What rounding, and what counts as the same place, may cost.
constexpr double rounding_m = 1e-8;
// Of the tolerance, what the searches leave to rounding.
constexpr double searched = 0.999;
constexpr int first_angles = 8;

using Points = std::vector<Eigen::Vector2d>;

Eigen::Vector2d centroid_of(std::span<const Eigen::Vector2d> points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d::Zero().eval());
  return sum / static_cast<double>(points.size());
}

Points about(const Eigen::Vector2d& centre, std::span<const Eigen::Vector2d> points) {
  Points moved;
  for (const Eigen::Vector2d& p : points) moved.push_back(p - centre);
  return moved;
}

std::span<const Eigen::Vector2d> checked(std::span<const Eigen::Vector2d> slots) {
  if (slots.empty() || !all_finite(slots)) {
    throw std::invalid_argument("rigid matching: no slots, or slots that are not finite");
  }
  return slots;
}

}  // namespace

RigidMatching::RigidMatching(std::span<const Eigen::Vector2d> slots,
                             const RigidMatchingOptions& options)
    : options_(options),
      slots_centroid_(centroid_of(checked(slots))),
      plan_(about(slots_centroid_, slots), searched * options.tolerance_m),
      symmetry_(rotational_symmetry(plan_.slots())),
      lattice_(LatticeSearch::of(plan_.slots(), searched * options.tolerance_m)) {
  if (!(options.tolerance_m > 0.0)) {
    throw std::invalid_argument("rigid matching: the tolerance must be above 0");
  }
}

RigidMatch RigidMatching::match(std::span<const Eigen::Vector2d> points,
                                const std::optional<Transform2>& prior) {
  if (points.empty() || points.size() > plan_.slots().size() || !all_finite(points)) {
    throw std::invalid_argument(
        "rigid matching: no points, more than slots, or points that are not finite");
  }
  const Eigen::Vector2d centroid = centroid_of(points);
  points_ = about(centroid, points);
  const auto count = static_cast<double>(points.size());
  const std::int64_t begin = work();
  const std::int64_t end = begin + options_.budget;

  plan_.set_points(points_);
  if (prior) plan_.try_pose({prior->angle(), *prior * centroid - slots_centroid_});
  if (!prior) try_turns(end);
  const auto open = [&](double bound) {
    return plan_.best().sum - bound > options_.tolerance_m * count;
  };
  double least = 0.0, tried = std::numeric_limits<double>::infinity();
  const auto search_lattice = [&] {
    if (!lattice_ || !open(least) || plan_.best().sum >= tried) return;
    tried = plan_.best().sum;
    least = std::max(least, lattice_->search(points_, plan_, 9 * (end - work()) / 10));
  };
  search_lattice();
  if (prior && open(least)) try_turns(end);
  search_lattice();
  if (open(least)) {
    PoseBox region = plan_.promising();
    region.arc = std::numbers::pi / symmetry_;
    const std::int64_t kept = lattice_ ? (end - work()) / 3 : 0;
    least = std::max(least, plan_.search(region, plan_.work() + end - work() - kept));
  }
  search_lattice();

  const RigidPose& pose = plan_.best().pose;
  const Transform2 turn = Transform2::from_angle(pose.angle, Eigen::Vector2d::Zero());
  RigidMatch match;
  match.T_slots_points = turn;
  match.T_slots_points.translation = pose.place + slots_centroid_ - turn.rotate(centroid);
  match.mean_m = plan_.best().sum / count;
  match.lower_bound_m = std::clamp(least / count - rounding_m, 0.0, match.mean_m);
  match.work = work() - begin;
  match.status = open(least) ? RigidMatchStatus::budget : RigidMatchStatus::exact;
  return match;
}

void RigidMatching::try_turns(std::int64_t most_work) {
  const double step = 2.0 * std::numbers::pi / (symmetry_ * first_angles);
  for (int k = 0; k < first_angles && (k == 0 || work() < most_work); ++k) {
    plan_.try_pose({k * step, Eigen::Vector2d::Zero()});
  }
}

}  // namespace shoal::solvers
