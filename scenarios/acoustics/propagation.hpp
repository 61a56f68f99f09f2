#pragma once

#include <Eigen/Core>

#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// How a ping travels through the water. Stateless and thread-safe.
class Propagation {
 public:
  static constexpr const char* family = "propagation";
  static constexpr const char* family_meaning = "how pings travel through the water";

  virtual ~Propagation() = default;

  /// How far the front of a ping has gone past the receiver, so many seconds after it left the
  /// sender (m); negative until it is there. Rises with time. Places are east, north and down.
  virtual double past_m(double since_s, const Eigen::Vector3d& sender,
                        const Eigen::Vector3d& receiver) const = 0;

  /// After how long a ping has reached all receivers at most so far away (s).
  virtual double longest_s(double range_m) const = 0;
};

}  // namespace shoal::scenarios
