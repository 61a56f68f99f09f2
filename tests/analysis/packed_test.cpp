#include "shoal/analysis/reporting/packed.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/nan_value.hpp"

namespace shoal::analysis {
namespace {

using shoal::tests::nan_value;

std::string text(std::initializer_list<std::uint8_t> bytes) {
  return packed_bytes(std::vector<std::uint8_t>(bytes));
}

// RFC 4648, sec. 10.
TEST(Packed, IsBase64) {
  EXPECT_EQ(text({}), "");
  EXPECT_EQ(text({'f'}), "Zg==");
  EXPECT_EQ(text({'f', 'o'}), "Zm8=");
  EXPECT_EQ(text({'f', 'o', 'o'}), "Zm9v");
  EXPECT_EQ(text({'f', 'o', 'o', 'b', 'a', 'r'}), "Zm9vYmFy");
  EXPECT_EQ(text({0xff, 0xfe}), "//4=");
}

TEST(Packed, HasTheLeastSignificantByteFirst) {
  EXPECT_EQ(packed_indices(std::vector<std::uint16_t>{0x0102}), text({0x02, 0x01}));
  EXPECT_EQ(packed_floats(std::vector<double>{1.0}), text({0x00, 0x00, 0x80, 0x3f}));
}

TEST(Packed, LevelsReachFromTheLeastToTheGreatest) {
  const auto packed = packed_levels(std::vector<double>{-1.0, nan_value, 65533.0});
  EXPECT_EQ(packed["offset"], -1.0);
  EXPECT_EQ(packed["scale"], 1.0);
  EXPECT_EQ(packed["data"], text({0x00, 0x00, 0xff, 0xff, 0xfe, 0xff}));
}

TEST(Packed, LevelsOfOneNumberOrNone) {
  EXPECT_EQ(packed_levels(std::vector<double>{7.0, 7.0})["offset"], 7.0);
  EXPECT_EQ(packed_levels(std::vector<double>{nan_value})["data"], text({0xff, 0xff}));
  EXPECT_EQ(packed_levels(std::vector<double>{})["data"], "");
}

TEST(Packed, StepsDoNotAddUpTheirErrors) {
  // A third of the unit at a time: counts 0 0 1 1 1 2 ...
  const auto packed =
      packed_steps(std::vector<double>{5.0, 5.0 + 0.01 / 3, 5.0 + 0.02 / 3, 5.01}, 1);
  EXPECT_EQ(packed["unit"], 0.01);
  EXPECT_EQ(packed["first"][0], 5.0);
  EXPECT_EQ(packed["data"], text({0, 0, 0, 0, 1, 0, 0, 0}));
}

TEST(Packed, StepsAreAsCoarseAsTheGreatestAsksFor) {
  const auto packed = packed_steps(std::vector<double>{0.0, 6400.0, 0.0, 0.0}, 2);
  EXPECT_EQ(packed["unit"], 0.2);
  EXPECT_EQ(packed["data"], text({0, 0, 0x00, 0x7d, 0, 0, 0, 0}));
}

TEST(Packed, ARowEndsWhereItsNumbersEnd) {
  const auto packed = packed_steps(std::vector<double>{1.0, nan_value, nan_value, nan_value}, 2);
  EXPECT_EQ(packed["first"].dump(), "[1.0,null]");
  EXPECT_EQ(packed["data"], text({0, 0, 0x00, 0x80, 0x00, 0x80, 0x00, 0x80}));
}

}  // namespace
}  // namespace shoal::analysis
