#include "shoal/core/text_lines.hpp"

#include <array>
#include <utility>

#include "shoal/core/whole_file.hpp"

namespace shoal {

TextLines::TextLines(std::istream& in, std::string name, std::size_t most_bytes)
    : in_(in), origin_{std::move(name), 0}, most_bytes_(most_bytes) {}

bool TextLines::next(std::string& line) {
  std::array<char, 65536> block;
  line.clear();
  for (bool found = false;;) {
    in_.getline(block.data(), block.size());
    const auto taken = static_cast<std::size_t>(in_.gcount());
    const bool ended = in_.good();  // by a newline, which is counted
    line.append(block.data(), ended ? taken - 1 : taken);
    bytes_ += taken;
    if (taken > 0 && !found) ++origin_.line;
    found = found || taken > 0;
    require_within_limits(line);
    const bool goes_on = taken > 0 && in_.fail() && !in_.eof() && !in_.bad();
    if (!goes_on) return found;
    in_.clear();  // it fails where a line is longer than the block
  }
}

void TextLines::require_within_limits(const std::string& line) const {
  if (line.size() > most_text_bytes) {
    throw InputError(origin_, "this line is longer than " + size_text(most_text_bytes) +
                                  ", which is the most that is read; name another file");
  }
  if (bytes_ > most_bytes_) {
    throw InputError(origin_, "here the file holds more than " + size_text(most_bytes_) +
                                  ", which is the most that is read; name another file, or cut "
                                  "this one");
  }
}

}  // namespace shoal
