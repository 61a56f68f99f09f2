#include "shoal/formations/ping_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::formations {

void PingFilterOptions::declare(Options<PingFilterOptions>& o) {
  using P = PingFilterOptions;
  o.number("timeout_s", &P::timeout_s, "s", above(0),
           "pings older than this leave the moving average (Rypkema 2015, Table 3.2)");
  o.number("contact_timeout_s", &P::contact_timeout_s, "s", above(0),
           "a neighbour unheard for this long is forgotten (Table 3.2)");
  o.number("gate_m", &P::gate_m, "m", above(0),
           "a ping without id belongs to a track no further away than this");
  o.number("rest_s", &P::rest_s, "s", at_least(0),
           "a track heard less than this ago did not send another ping without id");
}

void PingFilter::receive(const Ping& ping, const Eigen::Vector2d& own_position) {
  drop_silent(ping.time_s);
  const Sample sample{ping.time_s,
                      ping.range_m,
                      {std::cos(ping.bearing_rad), std::sin(ping.bearing_rad)},
                      {std::cos(ping.elevation_rad), std::sin(ping.elevation_rad)}};
  const Eigen::Vector2d measured =
      own_position + ping.range_m * sample.elevation.x() * sample.bearing;

  Track& track = track_of(ping, measured);
  track.heard_s = ping.time_s;
  track.state = ping.state;
  track.samples.push_back(sample);
  track.position = own_position + filtered(track, ping.time_s);
}

std::span<const Neighbour> PingFilter::neighbours(double time_s,
                                                  const Eigen::Vector2d& own_position) {
  drop_silent(time_s);
  neighbours_.resize(live_);
  for (std::size_t i = 0; i < live_; ++i) {
    const Track& track = tracks_[i];
    const double age_s = time_s - track.heard_s;
    neighbours_[i] = {track.position - own_position, age_s, track.slot};
    if (!track.state) continue;
    neighbours_[i].position = track.state->position + age_s * track.state->velocity - own_position;
    neighbours_[i].velocity = track.state->velocity;
    neighbours_[i].heading_rad = track.state->heading_rad;
  }
  return neighbours_;
}

void PingFilter::drop_silent(double time_s) {
  for (std::size_t i = 0; i < live_;) {
    if (time_s - tracks_[i].heard_s > options_.contact_timeout_s) {
      const auto gone = tracks_.begin() + static_cast<std::ptrdiff_t>(i);
      std::rotate(gone, gone + 1, tracks_.begin() + static_cast<std::ptrdiff_t>(live_));
      --live_;
    } else {
      ++i;
    }
  }
}

PingFilter::Track& PingFilter::track_of(const Ping& ping, const Eigen::Vector2d& measured) {
  Track* best = nullptr;
  double best_distance = options_.gate_m;
  for (std::size_t i = 0; i < live_; ++i) {
    Track& track = tracks_[i];
    if (ping.slot != anonymous) {
      if (track.slot == ping.slot) return track;
      continue;
    }
    if (track.slot != anonymous || ping.time_s - track.heard_s < options_.rest_s) continue;
    const double distance = (track.position - measured).norm();
    if (distance < best_distance) {
      best = &track;
      best_distance = distance;
    }
  }
  return best ? *best : new_track(ping.slot);
}

PingFilter::Track& PingFilter::new_track(int slot) {
  if (live_ == tracks_.size()) tracks_.emplace_back();
  Track& track = tracks_[live_++];
  track.slot = slot;
  track.samples.clear();
  return track;
}

Eigen::Vector2d PingFilter::filtered(Track& track, double time_s) const {
  const auto expired = [&](const Sample& s) { return time_s - s.time_s >= options_.timeout_s; };
  std::erase_if(track.samples, expired);

  double weights = 0.0, range = 0.0;
  Eigen::Vector2d bearing = Eigen::Vector2d::Zero();
  Eigen::Vector2d elevation = Eigen::Vector2d::Zero();
  for (const Sample& s : track.samples) {
    const double weight = 1.0 - (time_s - s.time_s) / options_.timeout_s;
    weights += weight;
    range += weight * s.range_m;
    bearing += weight * s.bearing;
    elevation += weight * s.elevation;
  }
  // Opposite directions cancel; then only the newest ping says where the neighbour is.
  const Sample& newest = track.samples.back();
  const double tiny = 1e-12 * weights;
  const Eigen::Vector2d direction =
      bearing.norm() > tiny ? bearing.normalized().eval() : newest.bearing;
  const double cos_elevation =
      elevation.norm() > tiny ? elevation.x() / elevation.norm() : newest.elevation.x();
  return (range / weights) * cos_elevation * direction;
}

}  // namespace shoal::formations
