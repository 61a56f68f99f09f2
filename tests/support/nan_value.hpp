#pragma once

#include <limits>

namespace shoal::tests {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

}  // namespace shoal::tests
