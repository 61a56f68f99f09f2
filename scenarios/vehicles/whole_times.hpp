#pragma once

#include <cmath>
#include <cstdint>

namespace shoal::scenarios {

/// How many of `part` make `whole`, or 0 if they do not.
inline std::int64_t whole_times(double whole, double part) {
  const double ratio = whole / part;
  const double rounded = std::round(ratio);
  return rounded >= 1.0 && std::abs(ratio - rounded) <= 1e-9 * rounded
             ? static_cast<std::int64_t>(rounded)
             : 0;
}

}  // namespace shoal::scenarios
