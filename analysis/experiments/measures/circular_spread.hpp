#pragma once

#include <optional>
#include <span>

namespace shoal::analysis {

/// How widely angles are spread (rad): their circular standard deviation, Mardia and Jupp 2000,
/// sec. 2.3.1. Turns by 1/order of a circle count as none. Of angles close to one another it is
/// their standard deviation; all round the circle it has no bound.
///
/// Nothing for fewer than two angles, and where they cancel out.
std::optional<double> circular_spread(std::span<const double> angles, int order);

}  // namespace shoal::analysis
