#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace shoal {

/// Writes a file that appears under its name only when it is complete, and on disk. If that fails
/// nothing is left of it, and a file that was there before stays as it was. What is no regular file
/// (a device, a pipe) is written to, and a link stays a link. Throws SystemError.
void write_whole_file(const std::filesystem::path& file, std::span<const char> content);

/// The most that is read of a file of text: one without an end, such as a device, would else take
/// all memory.
inline constexpr std::size_t most_text_bytes = 64'000'000;

/// So many bytes, in a message: `64 MB`.
std::string size_text(std::size_t bytes);

/// What a file holds, byte for byte; nothing if it cannot be read. Throws InputError if that is
/// more than `most_bytes`.
std::optional<std::string> read_whole_file(const std::filesystem::path& file,
                                           std::size_t most_bytes = most_text_bytes);

}  // namespace shoal
