#pragma once

#include <optional>
#include <span>

namespace shoal::analysis {

/// The greatest deviation of numbers from their least-squares line over time, as a share of the
/// last number's size. Nothing for fewer than three numbers, and where the last is zero.
std::optional<double> nonlinearity(std::span<const double> time_s, std::span<const double> numbers);

}  // namespace shoal::analysis
