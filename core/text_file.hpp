#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

#include "shoal/core/error.hpp"

namespace shoal {

/// The most that is read of a file of text, or of one line where lines are read one by one: a file
/// without an end, such as a device, would else take all memory.
inline constexpr std::size_t most_text_bytes = 64'000'000;

/// What a file of text holds, byte for byte; nothing if it cannot be read. Throws InputError if
/// that is more than most_text_bytes.
std::optional<std::string> read_text_file(const std::filesystem::path& file);

/// Reads a line, without its end; false if there is none. Throws InputError if it is longer than
/// most_text_bytes; `origin` is its place.
bool read_line(std::istream& in, std::string& line, const Origin& origin);

}  // namespace shoal
