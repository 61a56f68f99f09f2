#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "shoal/core/options.hpp"
#include "shoal/core/random.hpp"
#include "shoal/formations/ping_filter.hpp"
#include "shoal/scenarios/acoustics/ping_loss.hpp"
#include "shoal/scenarios/acoustics/ping_schedule.hpp"
#include "shoal/scenarios/acoustics/propagation.hpp"
#include "shoal/scenarios/vehicles/swarm.hpp"

namespace shoal::scenarios {

/// When vehicles ping, how far they are heard, and how well: Rypkema 2015, sec. 4.1.
struct PingOptions {
  double period_s = 30.0;
  Choice<PingSchedule> schedule{"synchronous"};
  double first_s = 0.0;
  double range_m = 550.0;
  Choice<Propagation> propagation{"straight"};
  double range_sd_m = 1.5;
  double bearing_sd_deg = 5.0;
  double elevation_sd_deg = 5.0;
  double minimum_range_m = 0.5;
  Choice<PingLoss> loss{"independent"};
  bool identified = true;
  bool carries_state = false;

  static void declare(Options<PingOptions>& o);
};

/// A ping that has left its sender and not yet reached one receiver.
struct PingUnderway {
  double x_m, y_m, depth_m;  ///< of the sender, at emission
  double emitted_s;
  std::uint32_t sender;
  std::uint32_t emission;  ///< how many pings the sender had sent before
  /// What it says of the sender, or nothing; the sender keeps it until it has arrived.
  const formations::OwnState* state = nullptr;
};

/// What one receiver is about to hear, and where it was when that was last looked at.
struct Hydrophone {
  std::vector<PingUnderway> underway;
  double x_m = 0.0, y_m = 0.0, depth_m = 0.0;
};

/// A ping as received, and where the receiver was then.
struct Reception {
  formations::Ping ping;
  Eigen::Vector2d own_position;
};

/// The acoustic channel: a ping spreads from where its sender was at emission, and is received when
/// its front passes the receiver, with noise, if it is not lost.
class Channel {
 public:
  Channel(const PingOptions& options, const RandomStreams& random);

  /// When a vehicle sends a ping, after so many others of its own.
  double emission_s(std::size_t vehicle, std::size_t vehicles, std::int64_t emission) const;
  /// How long a ping may be under way to a receiver in range.
  double longest_s() const { return propagation_->longest_s(options_.range_m); }
  /// True if this receiver misses this ping, which it is so far from.
  bool loses(const PingUnderway& ping, std::uint32_t receiver, double range_m) const;

  /// The pings that reach receiver `i` during the tick that ends at `now_s`, in order of arrival,
  /// appended to `received`. The swarm is where it is at `now_s`.
  void listen(const Swarm& swarm, std::size_t i, double now_s, double tick_s,
              Hydrophone& hydrophone, std::vector<Reception>& received) const;

  const PingOptions& options() const { return options_; }

 private:
  formations::Ping measured(const PingUnderway& ping, std::uint32_t receiver,
                            const Eigen::Vector3d& to_sender, double time_s) const;

  PingOptions options_;
  RandomStreams random_;
  std::shared_ptr<const PingSchedule> schedule_;
  std::shared_ptr<const Propagation> propagation_;
  std::shared_ptr<const PingLoss> loss_;
};

}  // namespace shoal::scenarios
