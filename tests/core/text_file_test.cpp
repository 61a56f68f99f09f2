#include "shoal/core/text_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/complaint_of.hpp"
#include "tests/support/scratch_folder.hpp"

namespace shoal {
namespace {

TEST(TextFile, IsReadByteForByte) {
  const tests::ScratchFolder folder;
  const std::string text("a\0b\r\n\xff", 6);
  folder.write("a.txt", text);
  EXPECT_EQ(read_text_file(folder.path() / "a.txt"), text);
  folder.write("empty.txt", "");
  EXPECT_EQ(read_text_file(folder.path() / "empty.txt"), "");
  EXPECT_EQ(read_text_file(folder.path()), std::nullopt);
  EXPECT_EQ(read_text_file(folder.path() / "none"), std::nullopt);
}

TEST(TextFile, HasALimitWhereTheFileHasNoEnd) {
  const std::string why = tests::complaint_of([] { read_text_file("/dev/zero"); });
  EXPECT_TRUE(why.starts_with("/dev/zero: the file holds more than 64 MB")) << why;
  std::ifstream zero("/dev/zero");
  std::string line;
  const std::string of_line = tests::complaint_of([&] { read_line(zero, line, {"zero", 1}); });
  EXPECT_TRUE(of_line.starts_with("zero:1: this line is longer than 64 MB")) << of_line;
}

TEST(TextFile, IsReadLineByLine) {
  const std::string wide(200'000, 'w'), block(65535, 'b');
  std::istringstream in("one\n\n" + wide + "\n" + block + "\nlast");
  std::string line;
  std::vector<std::string> lines;
  while (read_line(in, line, {})) lines.push_back(line);
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "", wide, block, "last"}));
}

}  // namespace
}  // namespace shoal
