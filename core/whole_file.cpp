#include "shoal/core/whole_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <system_error>

#include "shoal/core/error.hpp"

namespace shoal {

void write_whole_file(const std::filesystem::path& file, std::span<const char> content) {
  const auto partial = file.parent_path() / ("." + file.filename().string() + ".partial");
  errno = 0;
  std::FILE* out = std::fopen(partial.c_str(), "wb");
  bool written = out && std::fwrite(content.data(), 1, content.size(), out) == content.size();
  if (out) written = std::fclose(out) == 0 && written;

  std::error_code failed;
  if (!written) failed.assign(errno != 0 ? errno : EIO, std::generic_category());
  if (!failed) std::filesystem::rename(partial, file, failed);
  if (!failed) return;
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  throw SystemError("cannot write " + file.string() + ": " + failed.message() +
                    "; check free space and permissions");
}

std::optional<std::string> read_whole_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string content(std::istreambuf_iterator<char>(in), {});
  // A folder opens, but does not read.
  if (!in.is_open() || in.bad()) return std::nullopt;
  return content;
}

}  // namespace shoal
