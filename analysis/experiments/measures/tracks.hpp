#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "shoal/scenarios/world.hpp"

namespace shoal::analysis {

/// Places of one vehicle in the order in which it came to them, m.
using Track = std::vector<Eigen::Vector2d>;

/// Half the drifting radius of Rypkema 2015, Table 3.1: what is less is keeping a place.
inline constexpr double path_step_m = 10.0;

/// Tracks of all vehicles, in steps of a length and more: what is smaller than a step is no path.
class TrackLog {
 public:
  explicit TrackLog(double step_m) : step_m_(step_m) {}

  /// Calls `kept(i)` for every vehicle whose place became the end of another step.
  template <class Kept>
  void look(const scenarios::World& world, Kept&& kept) {
    tracks_.resize(world.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i)) continue;
      const Eigen::Vector2d place(world.swarm().x_m[i], world.swarm().y_m[i]);
      Track& track = tracks_[i];
      if (!track.empty() && (place - track.back()).squaredNorm() < step_m_ * step_m_) continue;
      track.push_back(place);
      kept(i);
    }
  }

  /// Those of vehicles that are left end where the vehicles are now.
  std::vector<Track> ended(const scenarios::World& world) const;
  const std::vector<Track>& tracks() const { return tracks_; }

 private:
  double step_m_;
  std::vector<Track> tracks_;
};

double length_m(std::span<const Eigen::Vector2d> track);

/// The part of a track up to the first place within `arrived_m` of its end: what comes after is
/// keeping a place. One place if that is the first; the track must have one.
std::span<const Eigen::Vector2d> approach(std::span<const Eigen::Vector2d> track, double arrived_m);

/// How much farther from its last place a track gets than it was at its first.
double away_m(std::span<const Eigen::Vector2d> track);

/// How many pairs of tracks cross. Tracks that only touch do not.
int crossing_pairs(std::span<const std::span<const Eigen::Vector2d>> tracks);

/// The angle (rad, 0 to pi) between the directions of two steps.
double turn(const Eigen::Vector2d& from, const Eigen::Vector2d& at, const Eigen::Vector2d& to);

}  // namespace shoal::analysis
