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

/// The sea is not larger, and the record's numbers would not hold a metre any more.
inline constexpr double farthest_start_m = 1e7;

/// Throws InputError if two vehicles are closer than a millimetre, or one is farther away than
/// that.
void require_usable(const std::vector<Start>& starts, const formations::Plan& plan,
                    const Origin& origin);

}  // namespace shoal::scenarios
