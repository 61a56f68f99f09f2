#include "shoal/core/interruption.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace shoal {
namespace {

TEST(Interruption, IsThatOfItsThreadAndEndsWithItsScope) {
  check_interruption();
  int outer = 0, inner = 0;
  {
    const Interruption first([&] { ++outer; });
    check_interruption();
    {
      const Interruption second([&] { ++inner; });
      check_interruption();
      std::thread([] { check_interruption(); }).join();
    }
    check_interruption();
  }
  check_interruption();
  EXPECT_EQ(outer, 2);
  EXPECT_EQ(inner, 1);
}

TEST(Interruption, PassesOnWhatTheCheckThrows) {
  const Interruption interruption([] { throw std::runtime_error("enough"); });
  EXPECT_THROW(check_interruption(), std::runtime_error);
}

}  // namespace
}  // namespace shoal
