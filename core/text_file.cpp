#include "shoal/core/text_file.hpp"

#include <array>
#include <fstream>

namespace shoal {
namespace {

std::string limit_text() {
  return std::to_string(most_text_bytes / 1'000'000) + " MB";
}

}  // namespace

std::optional<std::string> read_text_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string content;
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    content.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (content.size() > most_text_bytes) {
      throw InputError({file.string()}, "the file holds more than " + limit_text() +
                                            ", which is the most that is read as text; name "
                                            "another file, or cut this one");
    }
  }
  if (in.bad()) return std::nullopt;
  return content;
}

bool read_line(std::istream& in, std::string& line, const Origin& origin) {
  std::array<char, 65536> block;
  line.clear();
  for (bool found = false;;) {
    in.getline(block.data(), block.size());
    const auto taken = static_cast<std::size_t>(in.gcount());
    const bool ended = in.good();  // by a newline, which is counted
    line.append(block.data(), ended ? taken - 1 : taken);
    found = found || taken > 0;
    if (line.size() > most_text_bytes) {
      throw InputError(origin, "this line is longer than " + limit_text() +
                                   ", which is the most that is read as text; name another file");
    }
    const bool goes_on = taken > 0 && in.fail() && !in.eof() && !in.bad();
    if (!goes_on) return found;
    in.clear();  // it fails where a line is longer than the block
  }
}

}  // namespace shoal
