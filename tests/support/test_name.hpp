#pragma once

#include <algorithm>
#include <string>

namespace shoal::tests {

/// The name of a member as googletest takes it, which allows no dots: `nlopt_lbfgs`.
inline std::string test_name(std::string member) {
  std::ranges::replace(member, '.', '_');
  return member;
}

}  // namespace shoal::tests
