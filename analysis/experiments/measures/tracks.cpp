#include "shoal/analysis/experiments/measures/tracks.hpp"

#include <algorithm>
#include <cmath>

namespace shoal::analysis {
namespace {

struct Step {
  Eigen::Vector2d a, b;
  std::size_t track;

  double left() const { return std::min(a.x(), b.x()); }
  double right() const { return std::max(a.x(), b.x()); }
};

double side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = b - a, to = p - a;
  return along.x() * to.y() - along.y() * to.x();
}

bool cross(const Step& p, const Step& q) {
  return side(p.a, p.b, q.a) * side(p.a, p.b, q.b) < 0.0 &&
         side(q.a, q.b, p.a) * side(q.a, q.b, p.b) < 0.0;
}

}  // namespace

std::vector<Track> TrackLog::ended(const scenarios::World& world) const {
  std::vector<Track> tracks = tracks_;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Eigen::Vector2d place(world.swarm().x_m[i], world.swarm().y_m[i]);
    if (!world.lost(i) && tracks[i].back() != place) tracks[i].push_back(place);
  }
  return tracks;
}

double length_m(std::span<const Eigen::Vector2d> track) {
  double length = 0.0;
  for (std::size_t k = 1; k < track.size(); ++k) length += (track[k] - track[k - 1]).norm();
  return length;
}

std::span<const Eigen::Vector2d> approach(std::span<const Eigen::Vector2d> track,
                                          double arrived_m) {
  const auto arrived = std::ranges::find_if(track, [&](const Eigen::Vector2d& place) {
    return (place - track.back()).norm() <= arrived_m;
  });
  return track.first(static_cast<std::size_t>(arrived - track.begin()) + 1);
}

double away_m(std::span<const Eigen::Vector2d> track) {
  double farthest = 0.0;
  for (const Eigen::Vector2d& place : track) {
    farthest = std::max(farthest, (place - track.back()).norm());
  }
  return farthest - (track.front() - track.back()).norm();
}

int crossing_pairs(std::span<const std::span<const Eigen::Vector2d>> tracks) {
  // Swept from west to east: only steps that overlap in x are compared.
  std::vector<Step> steps;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    for (std::size_t k = 1; k < tracks[i].size(); ++k) {
      steps.push_back({tracks[i][k - 1], tracks[i][k], i});
    }
  }
  std::ranges::sort(steps, {}, &Step::left);
  std::vector<bool> known(tracks.size() * tracks.size());
  int pairs = 0;
  for (std::size_t p = 0; p < steps.size(); ++p) {
    for (std::size_t q = p + 1; q < steps.size() && steps[q].left() <= steps[p].right(); ++q) {
      const auto [low, high] = std::minmax(steps[p].track, steps[q].track);
      if (low == high || !cross(steps[p], steps[q])) continue;
      auto pair = known[low * tracks.size() + high];
      pairs += pair ? 0 : 1;
      pair = true;
    }
  }
  return pairs;
}

double turn(const Eigen::Vector2d& from, const Eigen::Vector2d& at, const Eigen::Vector2d& to) {
  const Eigen::Vector2d first = at - from, second = to - at;
  return std::abs(std::atan2(first.x() * second.y() - first.y() * second.x(), first.dot(second)));
}

}  // namespace shoal::analysis
