#pragma once

#include <cstddef>
#include <istream>
#include <string>

#include "shoal/core/error.hpp"

namespace shoal {

/// Reads a text line by line, without their ends, and knows where each stands.
///
/// A line has at most most_text_bytes (whole_file.hpp), the whole text as many as the reader
/// allows: a file without an end, such as a device, would else take all memory.
class TextLines {
 public:
  /// `name` stands for the text in messages.
  TextLines(std::istream& in, std::string name, std::size_t most_bytes);

  /// Whether there is another line. Throws InputError if it, or the text, is too long.
  bool next(std::string& line);

  const Origin& origin() const { return origin_; }  ///< of the line that was read last

 private:
  void require_within_limits(const std::string& line) const;

  std::istream& in_;
  Origin origin_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
};

}  // namespace shoal
