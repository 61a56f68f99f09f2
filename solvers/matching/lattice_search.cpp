#include "shoal/solvers/matching/lattice_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shoal/core/transform.hpp"

namespace shoal::solvers {
namespace {

// In multiples of the shortest vector between slots: how far from the points the lattice goes on at
// most, and by how much its part may be larger than needed before it is made anew.
constexpr double most_margin = 4.0;
constexpr double spare = 2.0;

bool before(const Eigen::Vector2i& a, const Eigen::Vector2i& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

}  // namespace

std::optional<LatticeSearch> LatticeSearch::of(std::span<const Eigen::Vector2d> slots,
                                               double tolerance_m) {
  const auto lattice = SlotLattice::of(slots);
  if (!lattice) return std::nullopt;
  return LatticeSearch(*lattice, slots, tolerance_m);
}

LatticeSearch::LatticeSearch(const SlotLattice& lattice, std::span<const Eigen::Vector2d> slots,
                             double tolerance_m)
    : lattice_(lattice), tolerance_m_(tolerance_m), width_m_(lattice.a.norm()) {
  height_m_ = (lattice.a.x() * lattice.b.y() - lattice.a.y() * lattice.b.x()) / width_m_;
  for (const Eigen::Vector2d& slot : slots) {
    cell_of_slot_.push_back(lattice.coordinates(slot - slots[0]));
  }
  std::ranges::sort(cell_of_slot_, before);
}

double LatticeSearch::search(std::span<const Eigen::Vector2d> points, PoseSearch& plan,
                             std::int64_t budget) {
  const double ceiling = plan.best().sum;
  if (ceiling > most_margin * width_m_) return 0.0;
  double farthest = 0.0;
  for (const Eigen::Vector2d& p : points) farthest = std::max(farthest, p.norm());
  cover(farthest + 0.5 * std::hypot(width_m_, height_m_) + ceiling);
  if (window_->slots().size() < points.size()) return 0.0;

  window_->set_points(points, ceiling);
  PoseBox region;
  region.arc = std::numbers::pi / lattice_.symmetry;
  region.half = {0.5 * width_m_, 0.5 * height_m_};
  const double least = window_->search(region, window_->work() + budget);
  if (const auto pose = fitted(plan.slots())) plan.try_pose(*pose);
  return std::min(least, ceiling);
}

void LatticeSearch::cover(double radius_m) {
  const double most = radius_m + spare * width_m_;
  if (window_ && window_radius_m_ >= radius_m && window_radius_m_ <= most) return;
  window_radius_m_ = radius_m + 0.5 * spare * width_m_;
  const double shift = lattice_.a.dot(lattice_.b) / width_m_;
  std::vector<Eigen::Vector2d> slots;
  const auto rows = static_cast<int>(window_radius_m_ / height_m_);
  for (int row = -rows; row <= rows; ++row) {
    const double y = row * height_m_, x = row * shift;
    const double half = std::sqrt(std::max(window_radius_m_ * window_radius_m_ - y * y, 0.0));
    const auto last = static_cast<int>(std::floor((half - x) / width_m_));
    for (int k = static_cast<int>(std::ceil((-half - x) / width_m_)); k <= last; ++k) {
      slots.emplace_back(x + k * width_m_, y);
    }
  }
  work_before_ = work();
  window_.emplace(slots, tolerance_m_);
}

// Where the slots that the best on the lattice takes are all in the plan, after a turn that
// permutes the lattice and a shift.
std::optional<RigidPose> LatticeSearch::fitted(std::span<const Eigen::Vector2d> slots) const {
  const PoseSearch::Best& best = window_->best();
  if (best.slot_of_point.empty()) return std::nullopt;
  const auto slot = [this](int j) { return window_->slots()[static_cast<std::size_t>(j)]; };
  const Eigen::Vector2d first = slot(best.slot_of_point[0]);
  for (int turn = 0; turn < lattice_.symmetry; ++turn) {
    const double angle = std::atan2(lattice_.a.y(), lattice_.a.x()) +
                         2.0 * std::numbers::pi * turn / lattice_.symmetry;
    const Transform2 T_plan_window = Transform2::from_angle(angle, Eigen::Vector2d::Zero());
    std::vector<Eigen::Vector2i> cells;
    for (const int j : best.slot_of_point) {
      cells.push_back(lattice_.coordinates(T_plan_window.rotate(slot(j) - first)));
    }
    for (const Eigen::Vector2d& origin : slots) {
      const Eigen::Vector2i shift = lattice_.coordinates(origin - slots[0]);
      const bool fits = std::ranges::all_of(cells, [&](const Eigen::Vector2i& cell) {
        return std::ranges::binary_search(cell_of_slot_, (cell + shift).eval(), before);
      });
      if (fits) {
        return RigidPose{best.pose.angle + angle,
                         T_plan_window.rotate(best.pose.place - first) + origin};
      }
    }
  }
  return std::nullopt;
}

}  // namespace shoal::solvers
