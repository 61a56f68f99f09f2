#include "shoal/scenarios/acoustics/ping_loss.hpp"

namespace shoal::scenarios {
namespace {

struct Independent final : PingLoss {
  double probability = 0.0;

  bool loses(const LeavingPing& ping, const RandomStreams& random) const override {
    if (probability <= 0.0) return false;
    return random.uniform(Purpose::ping_loss, ping.receiver, ping.number)[0] < probability;
  }

  static void declare(Options<Independent>& o) {
    o.number("probability", &Independent::probability, "", in(0, 1),
             "chance that a receiver misses a ping");
  }
};

const Register<PingLoss, Independent> registered{
    "independent", "each receiver misses each ping with the same chance, whatever happened before"};

}  // namespace
}  // namespace shoal::scenarios
