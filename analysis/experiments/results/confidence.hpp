#pragma once

namespace shoal::analysis {

/// Of all intervals that tables and claims print; their tests reject at `significance`.
inline constexpr double confidence = 0.95;
inline constexpr double significance = 1.0 - confidence;
/// The chance with which the replications that are called for would show a difference.
inline constexpr double wanted_power = 0.8;

}  // namespace shoal::analysis
