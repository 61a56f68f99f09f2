#include "shoal/core/whole_file.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

#include "shoal/core/error.hpp"

namespace shoal {
namespace {

namespace fs = std::filesystem;

/// Waits for it: else a file could get its name before its content, and be empty after a loss of
/// power. Devices and pipes have no disk.
bool is_on_disk(int file) {
  return ::fsync(file) == 0 || errno == EINVAL || errno == EROFS;
}

std::error_code write_bytes(const fs::path& file, std::span<const char> content) {
  errno = 0;
  std::FILE* out = std::fopen(file.c_str(), "wb");
  bool written = out && std::fwrite(content.data(), 1, content.size(), out) == content.size() &&
                 std::fflush(out) == 0 && is_on_disk(::fileno(out));
  if (out) written = std::fclose(out) == 0 && written;
  if (written) return {};
  return {errno != 0 ? errno : EIO, std::generic_category()};
}

std::error_code replace_file(const fs::path& file, std::span<const char> content) {
  const fs::path partial = file.parent_path() / ("." + file.filename().string() + ".partial");
  std::error_code failed = write_bytes(partial, content);
  if (!failed) fs::rename(partial, file, failed);
  std::error_code ignored;
  if (failed) fs::remove(partial, ignored);
  return failed;
}

}  // namespace

void write_whole_file(const fs::path& file, std::span<const char> content) {
  std::error_code unknown;
  // Behind a link the file that it leads to is replaced, and the link stays.
  const fs::path resolved = fs::is_symlink(file, unknown) ? fs::canonical(file, unknown) : file;
  const fs::file_status status = fs::status(file, unknown);
  const bool replaceable = !resolved.empty() &&
                           (fs::is_regular_file(status) || !fs::is_symlink(file, unknown)) &&
                           !fs::is_other(status);
  const std::error_code failed =
      replaceable ? replace_file(resolved, content) : write_bytes(file, content);
  if (failed) {
    throw SystemError("cannot write " + file.string() + ": " + failed.message() +
                      "; check free space and permissions");
  }
}

std::string size_text(std::size_t bytes) {
  constexpr std::size_t megabyte = 1'000'000;
  return bytes < megabyte ? std::to_string(bytes) + " bytes"
                          : std::to_string(bytes / megabyte) + " MB";
}

std::optional<std::string> read_whole_file(const fs::path& file, std::size_t most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string content;
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > most_bytes) {
      throw InputError({file.string()}, "the file holds more than " + size_text(most_bytes) +
                                            ", which is the most that is read; name another file, "
                                            "or cut this one");
    }
  }
  if (in.bad()) return std::nullopt;  // a folder opens, but does not read
  return content;
}

}  // namespace shoal
