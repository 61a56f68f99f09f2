#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace shoal::tests {

/// A file of the public reference data, which is not part of this repository: in $SHOAL_SHARED, or
/// in ../shared beside it.
inline std::filesystem::path shared_data(const std::string& name) {
  const char* given = std::getenv("SHOAL_SHARED");
  const std::filesystem::path root =
      given ? std::filesystem::path(given)
            : std::filesystem::path(SHOAL_SOURCE_DIR).parent_path() / "shared";
  return root / "data" / name;
}

}  // namespace shoal::tests

/// Skips the test, visibly, where the public data is not at hand.
#define SHOAL_NEEDS_SHARED(path)                                                             \
  if (!std::filesystem::exists(path)) {                                                      \
    GTEST_SKIP() << (path) << " is not here; set SHOAL_SHARED to the folder of public data"; \
  }
