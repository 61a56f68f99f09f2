#pragma once

#include <vector>

#include "shoal/core/random.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::scenarios {

/// Where a vehicle is when the mission starts.
struct Start {
  double x_m = 0.0;  ///< east of the origin
  double y_m = 0.0;  ///< north
  double heading_rad = 0.0;
};

/// A way to place the vehicles at mission start, one per slot of the plan and in its order.
class StartSource {
 public:
  static constexpr const char* family = "start";
  static constexpr const char* family_meaning = "where the vehicles are at mission start";

  virtual ~StartSource() = default;
  /// Throws InputError if the source does not fit the plan.
  virtual std::vector<Start> place(const formations::Plan& plan,
                                   const RandomStreams& random) const = 0;
};

/// Throws InputError if two vehicles are closer than a millimetre.
void require_distinct(const std::vector<Start>& starts, const formations::Plan& plan,
                      const Origin& origin);

}  // namespace shoal::scenarios
