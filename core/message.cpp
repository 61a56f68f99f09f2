#include "shoal/core/message.hpp"

#include <cstdio>

namespace shoal {

void write_message(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace shoal
