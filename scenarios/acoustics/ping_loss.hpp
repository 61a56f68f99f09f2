#pragma once

#include <cstdint>

#include "shoal/core/random.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// A ping that leaves for one receiver.
struct LeavingPing {
  std::uint32_t receiver;
  std::uint64_t number;  ///< of the ping, in the random streams of its receivers
  double range_m;        ///< from the sender, as the ping leaves it
};

/// Which pings are never heard, though they are in range. Stateless and thread-safe.
class PingLoss {
 public:
  static constexpr const char* family = "ping_loss";
  static constexpr const char* family_meaning = "which pings are missed, though they are in range";

  virtual ~PingLoss() = default;

  /// Draws from Purpose::ping_loss, or from a purpose of its own.
  virtual bool loses(const LeavingPing& ping, const RandomStreams& random) const = 0;
};

}  // namespace shoal::scenarios
