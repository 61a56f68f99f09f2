#include "shoal/scenarios/acoustics/channel.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/angles.hpp"

namespace shoal::scenarios {
namespace {

// The number of a ping in the random streams of its receiver.
std::uint64_t index_of(const PingUnderway& ping) {
  return (static_cast<std::uint64_t>(ping.emission) << 32) | ping.sender;
}

}  // namespace

void PingOptions::declare(Options<PingOptions>& o) {
  using P = PingOptions;
  o.number("period_s", &P::period_s, "s", above(0), "time between two pings of a vehicle");
  o.choice("schedule", &P::schedule, "when vehicles ping within the period");
  o.number("first_s", &P::first_s, "s", at_least(0), "time of the first ping");
  o.number("range_m", &P::range_m, "m", above(0), "how far a ping is heard (three-dimensional)");
  o.choice("propagation", &P::propagation, "how pings travel");
  o.number("range_sd_m", &P::range_sd_m, "m", at_least(0), "standard deviation of ranges");
  o.number("bearing_sd_deg", &P::bearing_sd_deg, "deg", at_least(0),
           "standard deviation of bearings");
  o.number("elevation_sd_deg", &P::elevation_sd_deg, "deg", at_least(0),
           "standard deviation of elevations; it shortens horizontal distances a little");
  o.number("minimum_range_m", &P::minimum_range_m, "m", at_least(0),
           "a modem measures no shorter range");
  o.choice("loss", &P::loss, "which pings are missed, though they are in range");
  o.flag("identified", &P::identified,
         "pings carry the sender's id; without, neighbours are told apart by where they are");
  o.flag("carries_state", &P::carries_state,
         "pings carry the sender's position, velocity and heading, as it believes them; they are "
         "then taken instead of what was measured (Barisic et al. 2011, sec. 3)");
}

Channel::Channel(const PingOptions& options, const RandomStreams& random)
    : options_(options),
      random_(random),
      schedule_(options.schedule.make()),
      propagation_(options.propagation.make()),
      loss_(options.loss.make()) {}

double Channel::emission_s(std::size_t vehicle, std::size_t vehicles, std::int64_t emission) const {
  const double delay_s = schedule_->delay_s(vehicle, vehicles, options_.period_s);
  return options_.first_s + delay_s + static_cast<double>(emission) * options_.period_s;
}

bool Channel::loses(const PingUnderway& ping, std::uint32_t receiver, double range_m) const {
  return loss_->loses({receiver, index_of(ping), range_m}, random_);
}

void Channel::listen(const Swarm& swarm, std::size_t i, double now_s, double tick_s,
                     Hydrophone& hydrophone, std::vector<Reception>& received) const {
  const Eigen::Vector3d here(swarm.x_m[i], swarm.y_m[i], swarm.depth_m[i]);
  const Eigen::Vector3d before(hydrophone.x_m, hydrophone.y_m, hydrophone.depth_m);
  const std::size_t already = received.size();

  std::erase_if(hydrophone.underway, [&](const PingUnderway& ping) {
    const Eigen::Vector3d sender(ping.x_m, ping.y_m, ping.depth_m);
    // How far the front of the ping is past the receiver, now and one tick ago.
    const double past = propagation_->past_m(now_s - ping.emitted_s, sender, here);
    if (past < 0.0) return false;
    const double past_before =
        propagation_->past_m(now_s - tick_s - ping.emitted_s, sender, before);
    const double share =
        past > past_before ? std::clamp(-past_before / (past - past_before), 0.0, 1.0) : 1.0;
    const Eigen::Vector3d there = before + share * (here - before);
    const Eigen::Vector3d to_sender = sender - there;
    if (to_sender.norm() <= options_.range_m) {
      const double arrival_s = now_s - (1.0 - share) * tick_s;
      received.push_back(
          {measured(ping, static_cast<std::uint32_t>(i), to_sender, arrival_s), there.head<2>()});
    }
    return true;
  });
  std::sort(received.begin() + static_cast<std::ptrdiff_t>(already), received.end(),
            [](const Reception& a, const Reception& b) { return a.ping.time_s < b.ping.time_s; });
  hydrophone.x_m = here.x();
  hydrophone.y_m = here.y();
  hydrophone.depth_m = here.z();
}

formations::Ping Channel::measured(const PingUnderway& ping, std::uint32_t receiver,
                                   const Eigen::Vector3d& to_sender, double time_s) const {
  const std::uint64_t index = index_of(ping);
  const auto [range_noise, bearing_noise] =
      random_.normal(Purpose::range_and_bearing, receiver, index);
  const double elevation_noise = random_.normal(Purpose::elevation, receiver, index)[0];

  formations::Ping heard;
  heard.time_s = time_s;
  heard.range_m =
      std::max(options_.minimum_range_m, to_sender.norm() + options_.range_sd_m * range_noise);
  heard.bearing_rad =
      std::atan2(to_sender.y(), to_sender.x()) + radians(options_.bearing_sd_deg) * bearing_noise;
  heard.elevation_rad = std::atan2(-to_sender.z(), to_sender.head<2>().norm()) +
                        radians(options_.elevation_sd_deg) * elevation_noise;
  heard.slot = options_.identified ? static_cast<int>(ping.sender) : formations::anonymous;
  if (ping.state) heard.state = *ping.state;
  return heard;
}

}  // namespace shoal::scenarios
