#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/formations/neighbourhood.hpp"

namespace shoal::formations {

/// One acoustic ping as the receiver measured it.
struct Ping {
  double time_s = 0.0;         ///< of reception
  double range_m = 0.0;        ///< one-way travel time x sound speed
  double bearing_rad = 0.0;    ///< to the sender, counter-clockwise from east
  double elevation_rad = 0.0;  ///< to the sender, upwards positive
  int slot = anonymous;        ///< the sender's slot of the plan, if the ping carries an id
  /// What the sender says of itself, if the ping carries that: in the frame of the own positions,
  /// which the two must share.
  std::optional<OwnState> state = std::nullopt;
};

/// Parameters of the ping filter: Rypkema 2015, Table 3.2.
struct PingFilterOptions {
  double timeout_s = 120.0;
  double contact_timeout_s = 120.0;
  double gate_m = 150.0;
  double rest_s = 2.5;

  static void declare(Options<PingFilterOptions>& o);
};

/// Keeps track of the neighbours of one vehicle from their pings.
///
/// Per neighbour, range and bearing are averaged over the pings of the last `timeout_s`, each
/// weighted by 1 - age / timeout (Rypkema 2015, Alg. 3). Between pings a neighbour is taken to stay
/// where it was, and the own motion is followed by dead reckoning: own positions are given in any
/// fixed frame with axes east and north.
///
/// Pings with an id belong to the track of that slot. Pings without are given to the nearest track
/// inside `gate_m` that was not heard within the last `rest_s` (no vehicle pings twice in so short
/// a time); if there is none, a new track begins. Tracks unheard for `contact_timeout_s` are
/// dropped.
///
/// A neighbour whose last ping carried its state is taken at its word instead, and to move on as it
/// did then (Barisic et al. 2011, sec. 3: agents tell one another their states).
class PingFilter {
 public:
  explicit PingFilter(const PingFilterOptions& options = {}) : options_(options) {}

  /// Pings must come in the order of their times.
  void receive(const Ping& ping, const Eigen::Vector2d& own_position);

  /// The neighbours relative to the own position, in the order in which they were first heard.
  /// The span is valid until the next call.
  std::span<const Neighbour> neighbours(double time_s, const Eigen::Vector2d& own_position);
  /// The same again, as last returned.
  std::span<const Neighbour> last_neighbours() const { return neighbours_; }

 private:
  struct Sample {
    double time_s, range_m;
    Eigen::Vector2d bearing, elevation;  // cosine and sine
  };
  struct Track {
    int slot = anonymous;
    double heard_s = 0.0;
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  // in the frame of the own positions
    std::optional<OwnState> state;                       // as the last ping said
    std::vector<Sample> samples;
  };

  void drop_silent(double time_s);
  Track& track_of(const Ping& ping, const Eigen::Vector2d& measured);
  Track& new_track(int slot);
  Eigen::Vector2d filtered(Track& track, double time_s) const;

  PingFilterOptions options_;
  std::vector<Track> tracks_;
  std::size_t live_ = 0;  // the first `live_` tracks; the others keep their memory for later
  std::vector<Neighbour> neighbours_;
};

}  // namespace shoal::formations
