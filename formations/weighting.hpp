#pragma once

#include <cstdint>

namespace shoal::formations {

/// What makes something heard count for less than 1: nothing, how far away it is, or how old.
enum class Weighting : std::uint8_t { none, distance, ping_age };

}  // namespace shoal::formations
