#pragma once

// Settings as if written in line 4 of dir/s.toml, and what is said of them.

#include <cstdint>
#include <string>
#include <utility>

#include "shoal/core/setting.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal::tests {

template <class T>
Setting value(T x) {
  Setting setting;
  setting.value = x;
  setting.origin = {"dir/s.toml", 4};
  return setting;
}

inline Setting integer(std::int64_t x) {
  return value(x);
}
inline Setting text(const char* x) {
  return value(std::string(x));
}

inline Setting with(const std::string& path, Setting x) {
  Setting root;
  root.origin = {"dir/s.toml", 1};
  assign(root, path, std::move(x));
  return root;
}

}  // namespace shoal::tests
