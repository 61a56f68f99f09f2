#include "fuzzed.hpp"

#include <cstdlib>
#include <iostream>

namespace shoal::tests {

void fault(const std::string& why) {
  std::cerr << "fault: " << why << '\n';
  std::abort();
}

}  // namespace shoal::tests
