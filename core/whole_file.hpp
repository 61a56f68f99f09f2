#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace shoal {

/// Writes a file that appears under its name only when it is complete, and on disk. If that fails
/// nothing is left of it, and a file that was there before stays as it was. What is no regular file
/// (a device, a pipe) is written to, and a link stays a link. Throws SystemError.
void write_whole_file(const std::filesystem::path& file, std::span<const char> content);

/// What a file holds, byte for byte; nothing if it cannot be read.
std::optional<std::string> read_whole_file(const std::filesystem::path& file);

}  // namespace shoal
