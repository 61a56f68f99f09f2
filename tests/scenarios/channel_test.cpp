#include "shoal/scenarios/acoustics/channel.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shoal/core/angles.hpp"

namespace shoal::scenarios {
namespace {

constexpr double channel_tick_s = 0.25;

struct Still final : Swarm {
  using Swarm::Swarm;
  formations::OwnState own_state(std::size_t) const override { return {}; }
  void advance(std::size_t, std::size_t, std::int64_t, std::span<const formations::Command>,
               std::span<const double>, std::span<const double>) override {}
};

PingOptions noiseless() {
  PingOptions options;
  options.range_sd_m = options.bearing_sd_deg = options.elevation_sd_deg = 0.0;
  return options;
}

/// A receiver (vehicle 0) at (x, y, depth), and a ping from the origin at time zero.
struct Listener {
  Channel channel;
  Still swarm{1};
  Hydrophone hydrophone;
  std::vector<Reception> received;

  Listener(const PingOptions& options, double x, double y, double depth = 0.0,
           std::uint32_t emission = 0)
      : channel(options, RandomStreams(3)) {
    move(x, y, depth);
    hydrophone.x_m = x;
    hydrophone.y_m = y;
    hydrophone.depth_m = depth;
    hydrophone.underway.push_back({0.0, 0.0, 0.0, 0.0, 5, emission});
  }
  void move(double x, double y, double depth = 0.0) {
    swarm.x_m[0] = x;
    swarm.y_m[0] = y;
    swarm.depth_m[0] = depth;
  }
  void listen(double now_s) {
    channel.listen(swarm, 0, now_s, channel_tick_s, hydrophone, received);
  }
};

TEST(Channel, APingArrivesAfterItsTravelTime) {
  Listener listener(noiseless(), 300.0, 400.0);  // 500 m: a third of a second
  listener.listen(0.25);
  EXPECT_TRUE(listener.received.empty());
  listener.listen(0.5);
  ASSERT_EQ(listener.received.size(), 1u);
  const formations::Ping& ping = listener.received[0].ping;
  EXPECT_NEAR(ping.time_s, 500.0 / 1500.0, 1e-12);
  EXPECT_NEAR(ping.range_m, 500.0, 1e-9);
  EXPECT_NEAR(std::cos(ping.bearing_rad - std::atan2(-400.0, -300.0)), 1.0, 1e-12);
  EXPECT_EQ(ping.slot, 5);
  EXPECT_TRUE(listener.hydrophone.underway.empty());
}

TEST(Channel, AMovingReceiverHearsItWhereItIsByThen) {
  Listener listener(noiseless(), 300.0, 0.0);
  listener.move(300.25, 0.0);  // 1 m/s outwards: 1500 t = 300 + t
  listener.listen(0.25);
  ASSERT_EQ(listener.received.size(), 1u);
  EXPECT_NEAR(listener.received[0].ping.time_s, 300.0 / 1499.0, 1e-9);
  EXPECT_NEAR(listener.received[0].own_position.x(), 300.0 + 300.0 / 1499.0, 1e-9);
  EXPECT_NEAR(listener.received[0].ping.range_m, 300.0 + 300.0 / 1499.0, 1e-9);
}

TEST(Channel, RangeIsThreeDimensionalAndEndsSharply) {
  Listener deep(noiseless(), 545.0, 0.0, 100.0);  // 554 m away
  deep.listen(0.5);
  EXPECT_TRUE(deep.received.empty());
  EXPECT_TRUE(deep.hydrophone.underway.empty());
  Listener near(noiseless(), 540.0, 0.0, 100.0);  // 549 m
  near.listen(0.5);
  ASSERT_EQ(near.received.size(), 1u);
  EXPECT_NEAR(near.received[0].ping.range_m * std::cos(near.received[0].ping.elevation_rad), 540.0,
              1e-9);
  EXPECT_GT(near.received[0].ping.elevation_rad, 0.0);  // the sender is above
}

TEST(Channel, PingsAreHeardInTheOrderOfTheirArrival) {
  Listener listener(noiseless(), 200.0, 0.0);
  listener.hydrophone.underway.push_back({100.0, 0.0, 0.0, 0.0, 6, 0});
  listener.listen(0.25);
  ASSERT_EQ(listener.received.size(), 2u);
  EXPECT_EQ(listener.received[0].ping.slot, 6);
  EXPECT_EQ(listener.received[1].ping.slot, 5);
}

TEST(Channel, NoiseHasTheStandardDeviationsAskedFor) {
  PingOptions options;
  options.elevation_sd_deg = 3.0;
  double range = 0.0, bearing = 0.0, elevation = 0.0;
  constexpr int n = 4000;
  for (std::uint32_t k = 0; k < n; ++k) {
    Listener listener(options, 300.0, 0.0, 0.0, k);
    listener.listen(0.25);
    const formations::Ping& ping = listener.received.at(0).ping;
    range += std::pow(ping.range_m - 300.0, 2);
    bearing += std::pow(wrapped(ping.bearing_rad - radians(180)), 2);
    elevation += std::pow(ping.elevation_rad, 2);
  }
  EXPECT_NEAR(std::sqrt(range / n), 1.5, 0.06);
  EXPECT_NEAR(degrees(std::sqrt(bearing / n)), 5.0, 0.2);
  EXPECT_NEAR(degrees(std::sqrt(elevation / n)), 3.0, 0.12);
}

TEST(Channel, AModemMeasuresNoRangeBelowItsShortest) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    Listener listener(PingOptions{}, 0.1, 0.0, 0.0, k);
    listener.listen(0.25);
    EXPECT_GE(listener.received.at(0).ping.range_m, 0.5);
  }
}

TEST(Channel, LosesTheShareOfPingsAskedFor) {
  PingOptions lossy;
  lossy.loss.setting().tables.at_or_new("independent").at_or_new("probability").value = 0.3;
  const Channel channel(lossy, RandomStreams(3));
  int lost = 0;
  for (std::uint32_t k = 0; k < 10000; ++k)
    lost += channel.loses({0, 0, 0, 0.0, 1, k}, 2, 100.0) ? 1 : 0;
  EXPECT_NEAR(lost / 10000.0, 0.3, 0.015);
  EXPECT_FALSE(Channel(PingOptions{}, RandomStreams(3)).loses({0, 0, 0, 0.0, 1, 0}, 2, 100.0));
}

/// Pings from afar are missed.
struct FarLost final : PingLoss {
  bool loses(const LeavingPing& ping, const RandomStreams&) const override {
    return ping.range_m > 100.0;
  }
  static void declare(Options<FarLost>&) {}
};
const Register<PingLoss, FarLost> registered_loss{"test_far_lost", "beyond 100 m"};

TEST(Channel, ALossOfOnesOwnMayGoByTheDistance) {
  PingOptions options;
  options.loss = Choice<PingLoss>("test_far_lost");
  const Channel channel(options, RandomStreams(3));
  EXPECT_FALSE(channel.loses({0, 0, 0, 0.0, 1, 0}, 2, 99.0));
  EXPECT_TRUE(channel.loses({0, 0, 0, 0.0, 1, 0}, 2, 101.0));
}

TEST(Channel, WithoutIdsPingsAreAnonymous) {
  PingOptions options = noiseless();
  options.identified = false;
  Listener listener(options, 100.0, 0.0);
  listener.listen(0.25);
  EXPECT_EQ(listener.received.at(0).ping.slot, formations::anonymous);
}

}  // namespace
}  // namespace shoal::scenarios
