#pragma once

#include <stdexcept>
#include <string>

namespace shoal {

/// Where a value was written: a file and its line, or the command line (`--set`, line 0).
struct Origin {
  std::string file;
  int line = 0;

  /// `file:line: `, `file: ` or nothing, as it stands in front of a message.
  std::string prefix() const;
};

/// Input that cannot be used. The message says where, what is wrong and what to do.
class InputError : public std::runtime_error {
 public:
  InputError(const Origin& origin, const std::string& message)
      : std::runtime_error(origin.prefix() + message) {}
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

/// The surroundings failed (a full disk, an unwritable directory), not the input.
class SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace shoal
