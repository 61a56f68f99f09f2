#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace shoal::analysis {

// Numbers as text for a page; page/unpack.js reads them. 16 bits are as much as a screen shows.

/// Little-endian 32-bit floats, base64.
std::string packed_floats(std::span<const double> numbers);
std::string packed_indices(std::span<const std::uint16_t> indices);
std::string packed_bytes(std::span<const std::uint8_t> bytes);

/// In 65,535 levels between the least and the greatest; NaN stays none.
nlohmann::ordered_json packed_levels(std::span<const double> numbers);

/// Rows of equal length, each by its first number and differences, in a unit of 0.01 or as coarse
/// as the greatest difference asks for. Errors do not add up. From its first NaN on, a row has
/// ended.
nlohmann::ordered_json packed_steps(std::span<const double> numbers, std::size_t rows);

}  // namespace shoal::analysis
