#include "shoal/solvers/matching/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shoal/core/interruption.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/points.hpp"

namespace shoal::solvers {
namespace {

constexpr double same_sum_m = 1e-9;
constexpr std::int64_t most_assignment_work = 20'000'000;  // distances
constexpr std::int64_t lookup_work = 4;                    // takes as long as so many distances
// An assignment tells little about a box that leaves the angle so open.
constexpr double widest_spread = 0.5;
// What the nearest slots are ahead of the best, in disc radii, so that a few splits do without
// more.
constexpr double enough_lead = 0.25;
// Assignments that may be the best somewhere in one box, and steps to list them.
constexpr std::size_t most_rivals = 24;
constexpr int most_tries = 400;

bool later(const PoseBox& a, const PoseBox& b) {
  return a.bound != b.bound ? a.bound > b.bound : a.serial > b.serial;
}

/// From a slot to the nearest other, on average.
double spacing_of(std::span<const Eigen::Vector2d> slots) {
  double sum = 0.0;
  for (const Eigen::Vector2d& slot : slots) {
    check_interruption();
    double least = infinity;
    for (const Eigen::Vector2d& other : slots) {
      if (&other != &slot) least = std::min(least, (other - slot).squaredNorm());
    }
    sum += std::sqrt(least);
  }
  return sum / static_cast<double>(slots.size());
}

}  // namespace

PoseSearch::PoseSearch(std::span<const Eigen::Vector2d> slots, double tolerance_m)
    : tolerance_m_(tolerance_m),
      slots_(slots.begin(), slots.end()),
      slot_x_(static_cast<Eigen::Index>(slots.size())),
      slot_y_(slot_x_.size()),
      field_(slots),
      spacing_m_(spacing_of(slots)) {
  for (Eigen::Index j = 0; j < slot_x_.size(); ++j) {
    slot_x_[j] = slots_[static_cast<std::size_t>(j)].x();
    slot_y_[j] = slots_[static_cast<std::size_t>(j)].y();
  }
}

void PoseSearch::set_points(std::span<const Eigen::Vector2d> points, double ceiling) {
  points_.assign(points.begin(), points.end());
  radius_.clear();
  for (const Eigen::Vector2d& p : points_) radius_.push_back(p.norm());
  mean_radius_ =
      std::accumulate(radius_.begin(), radius_.end(), 0.0) / static_cast<double>(radius_.size());
  farthest_ = *std::ranges::max_element(radius_);
  known_count_ = 0;
  best_.sum = ceiling;
  best_.slot_of_point.clear();
}

std::int64_t PoseSearch::work() const {
  const auto columns = static_cast<std::int64_t>(slots_.size());
  return looked_at_ + assignment_.rows_scanned() * columns + pairs_.work();
}

void PoseSearch::try_pose(const RigidPose& pose) {
  discs_.clear();
  const Transform2 turn = Transform2::from_angle(pose.angle, pose.place);
  for (const Eigen::Vector2d& p : points_) discs_.push_back(turn * p);
  assign();
  known(assignment_.column_of(), pose);
}

// Of all points to the middles of their discs.
void PoseSearch::assign() {
  looked_at_ += static_cast<std::int64_t>(discs_.size() * slots_.size());
  const Eigen::Index columns = slot_x_.size();
  costs_.resize(discs_.size() * slots_.size());
  double* row = costs_.data();
  for (const Eigen::Vector2d& p : discs_) {
    Eigen::Map<Eigen::ArrayXd>(row, columns) =
        ((slot_x_ - p.x()).square() + (slot_y_ - p.y()).square()).sqrt();
    row += columns;
  }
  // In a large swarm that is far from formed, one optimal assignment would take minutes.
  assignment_.solve(costs_, static_cast<int>(discs_.size()), static_cast<int>(columns),
                    AssignmentSolver::unbounded, most_assignment_work / columns);
}

// Where it is not known yet, its least sum near this pose is sought, which may be the best so far;
// then the assignment that is optimal there is tried in turn.
std::size_t PoseSearch::known(std::span<const int> slot_of, const RigidPose& pose) {
  const Eigen::Vector2d first = slots_[static_cast<std::size_t>(slot_of[0])];
  targets_.clear();
  for (const int slot : slot_of) targets_.push_back(slots_[static_cast<std::size_t>(slot)] - first);
  for (std::size_t k = 0; k < known_count_; ++k) {
    const bool same = std::ranges::equal(
        targets_, known_[k].targets, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
          return (a - b).squaredNorm() <= same_place_m * same_place_m;
        });
    if (same) return k;
  }
  const std::size_t index = known_count_++;
  if (known_.size() <= index) known_.emplace_back();
  Known& added = known_[index];
  std::swap(added.targets, targets_);
  pairs_.set(points_, added.targets);
  added.pose = pairs_.descended({pose.angle, pose.place - first});
  added.sum = pairs_.sum(added.pose);
  added.certified = false;
  if (added.sum < best_.sum - same_sum_m) {
    best_ = {
        {added.pose.angle, added.pose.place + first}, added.sum, {slot_of.begin(), slot_of.end()}};
    try_pose(best_.pose);
  }
  return index;
}

double PoseSearch::certified_sum(std::size_t index, std::span<const int> slot_of) {
  Known& k = known_[index];
  if (k.certified) return k.bound_below;
  pairs_.set(points_, k.targets);
  const PairedDistances::Least least = pairs_.least(k.pose, 0.5 * slack());
  k.pose = least.pose;
  k.sum = least.sum;
  k.bound_below = least.bound_below;
  k.certified = true;
  if (k.sum < best_.sum - same_sum_m) {
    const Eigen::Vector2d first = slots_[static_cast<std::size_t>(slot_of[0])];
    best_ = {{k.pose.angle, k.pose.place + first}, k.sum, {slot_of.begin(), slot_of.end()}};
  }
  return k.bound_below;
}

PoseBox PoseSearch::promising() const {
  const auto n = static_cast<std::ptrdiff_t>(points_.size());
  const auto count = static_cast<double>(points_.size());
  const double reach = best_.sum / count;
  PoseBox box;
  std::vector<double> sorted(slots_.size());
  for (int axis = 0; axis < 2; ++axis) {
    std::ranges::transform(slots_, sorted.begin(), [axis](const auto& slot) { return slot[axis]; });
    std::ranges::sort(sorted);
    const double low = std::accumulate(sorted.begin(), sorted.begin() + n, 0.0) / count - reach;
    const double high = std::accumulate(sorted.end() - n, sorted.end(), 0.0) / count + reach;
    box.middle.place[axis] = 0.5 * (low + high);
    box.half[axis] = 0.5 * (high - low);
  }
  return box;
}

double PoseSearch::search(const PoseBox& region, std::int64_t most_work) {
  double closed = infinity;
  open_.assign(1, region);
  while (!open_.empty() && open_.front().bound < limit() && work() < most_work) {
    check_interruption();
    std::ranges::pop_heap(open_, later);
    PoseBox box = open_.back();
    open_.pop_back();
    if (!box.nearest_suffice) look(box);
    if (box.bound >= limit()) {
      closed = std::min(closed, box.bound);
      continue;
    }
    auto [one, other] = box.split(mean_radius_);
    for (PoseBox* half : {&one, &other}) {
      half->serial = ++serial_;
      glance(*half);
      if (half->bound >= limit()) {
        closed = std::min(closed, half->bound);
      } else {
        open_.push_back(*half);
        std::ranges::push_heap(open_, later);
      }
    }
  }
  return std::min(closed, open_.empty() ? infinity : open_.front().bound);
}

void PoseSearch::place_discs(const PoseBox& box) {
  const Transform2 turn = box.discs();
  discs_.clear();
  for (const Eigen::Vector2d& p : points_) discs_.push_back(turn * p);
  disc_radius_.clear();
  for (const double radius : radius_) disc_radius_.push_back(radius * box.spread() + box.reach());
}

void PoseSearch::glance(PoseBox& box) {
  const auto count = static_cast<double>(points_.size());
  looked_at_ += lookup_work * static_cast<std::int64_t>(points_.size());
  const Transform2 turn = box.discs();
  const double spread = box.spread(), reach = box.reach();
  double bound = 0.0, middle = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector2d p = turn * points_[i];
    const double nearest = field_.distance_at_least(p.x(), p.y());
    middle += nearest;
    bound += std::max(nearest - radius_[i] * spread - reach, 0.0);
  }
  box.bound = std::max(box.bound, bound);
  const double lead = middle - limit();
  const bool wide = middle / count + farthest_ * spread + reach > 0.5 * spacing_m_;
  box.nearest_suffice =
      lead >= 0.0 && (wide || lead > enough_lead * count * (mean_radius_ * spread + reach));
}

void PoseSearch::look(PoseBox& box) {
  if (box.spread() > widest_spread) {
    box.bound = std::max(box.bound, bound_of_all_angles(box));
    return;
  }
  place_discs(box);
  assign();
  box.bound = std::max(box.bound, bound_of_discs());
  if (box.bound >= limit()) return;
  const double change = least_change();
  first_.assign(assignment_.column_of().begin(), assignment_.column_of().end());
  const std::size_t index = known(first_, box.middle);
  // First as if nothing were lost in the proof of its sum, which is much more work.
  if (!list_rivals(limit() - known_[index].sum - change)) return;
  if (!list_rivals(limit() - certified_sum(index, first_) - change)) return;
  double bound = limit();
  for (std::size_t r = 0; r < rivals_count_; ++r) {
    bound = std::min(bound, certified_sum(known(rivals_[r], box.middle), rivals_[r]));
  }
  box.bound = std::max(box.bound, bound);
}

// The point is the centroid of all: as many slots as there are points, the nearest to it.
double PoseSearch::bound_of_all_angles(const PoseBox& box) {
  looked_at_ += static_cast<std::int64_t>(slots_.size());
  const auto count = static_cast<std::ptrdiff_t>(points_.size());
  const Eigen::Vector2d& at = box.middle.place;
  costs_.resize(slots_.size());
  Eigen::Map<Eigen::ArrayXd>(costs_.data(), slot_x_.size()) =
      ((slot_x_ - at.x()).square() + (slot_y_ - at.y()).square()).sqrt();
  std::nth_element(costs_.begin(), costs_.begin() + (count - 1), costs_.end());
  const double nearest = std::accumulate(costs_.begin(), costs_.begin() + count, 0.0);
  return nearest - static_cast<double>(count) * (mean_radius_ + box.reach());
}

// The prices of the assignment at the middles are good ones for the discs, too.
double PoseSearch::bound_of_discs() const {
  const Eigen::Index columns = slot_x_.size();
  const Eigen::Map<const Eigen::ArrayXd> prices(assignment_.prices().data(), columns);
  double bound = assignment_.price_sum();
  const double* row = costs_.data();
  for (const double radius : disc_radius_) {
    const Eigen::Map<const Eigen::ArrayXd> distances(row, columns);
    bound += ((distances - radius).max(0.0) - prices).minCoeff();
    row += columns;
  }
  return bound;
}

// By how much another assignment can be better than this one, for points anywhere in their discs;
// `reduced_` says by how much less if it takes a pair. |x - a| - |x - b| changes by no more than
// 2 |a - b| / (|x - a| + |x - b|) a metre, and 2.
double PoseSearch::least_change() {
  const Eigen::Index columns = slot_x_.size();
  const Eigen::Map<const Eigen::ArrayXd> prices(assignment_.prices().data(), columns);
  double bound = assignment_.price_sum();
  reduced_.resize(costs_.size());
  const double* row = costs_.data();
  double* into = reduced_.data();
  for (std::size_t i = 0; i < discs_.size(); ++i) {
    const Eigen::Map<const Eigen::ArrayXd> distances(row, columns);
    Eigen::Map<Eigen::ArrayXd> reduced(into, columns);
    const int own = assignment_.column_of()[i];
    const double radius = disc_radius_[i], distance = distances[own];
    const auto apart =
        ((slot_x_ - slot_x_[own]).square() + (slot_y_ - slot_y_[own]).square()).sqrt();
    const auto far = (distances + (distance - 2.0 * radius)).max(1e-9);
    const auto slope = (2.0 * apart / far).min(2.0);
    reduced = distances - distance - radius * slope - prices;
    const double least = reduced.minCoeff();
    bound += least;
    reduced -= least;
    row += columns;
    into += columns;
  }
  return std::min(bound, 0.0);
}

// All assignments whose reduced costs sum up to less than `room`; false if they are too many.
bool PoseSearch::list_rivals(double room) {
  rivals_count_ = 0;
  tries_ = 0;
  partial_.clear();
  taken_.assign(slots_.size(), false);
  return room <= 0.0 || list_rivals_from(0, room);
}

bool PoseSearch::list_rivals_from(std::size_t row, double room) {
  if (row == points_.size()) {
    if (rivals_count_ == most_rivals) return false;
    if (rivals_.size() == rivals_count_) rivals_.emplace_back();
    rivals_[rivals_count_++] = partial_;
    return true;
  }
  const double* reduced = reduced_.data() + row * slots_.size();
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    if (taken_[j] || reduced[j] >= room) continue;
    if (++tries_ > most_tries) return false;
    taken_[j] = true;
    partial_.push_back(static_cast<int>(j));
    const bool listed = list_rivals_from(row + 1, room - reduced[j]);
    partial_.pop_back();
    taken_[j] = false;
    if (!listed) return false;
  }
  return true;
}

}  // namespace shoal::solvers
