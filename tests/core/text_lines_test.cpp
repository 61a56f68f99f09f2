#include "shoal/core/text_lines.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/complaint_of.hpp"

namespace shoal {
namespace {

TEST(TextLines, AreReadOneByOneWithoutTheirEnds) {
  const std::string wide(200'000, 'w'), block(65535, 'b');
  std::istringstream in("one\n\n" + wide + "\n" + block + "\nlast");
  TextLines lines(in, "text", 1'000'000);
  std::string line;
  std::vector<std::string> all;
  while (lines.next(line)) {
    all.push_back(line);
    EXPECT_EQ(lines.origin().line, static_cast<int>(all.size()));
  }
  EXPECT_EQ(all, (std::vector<std::string>{"one", "", wide, block, "last"}));
}

TEST(TextLines, HaveALimitWhereALineHasNoEnd) {
  std::ifstream zero("/dev/zero");
  TextLines lines(zero, "zero", 1'000'000'000);
  std::string line;
  const std::string why = tests::complaint_of([&] { lines.next(line); });
  EXPECT_TRUE(why.starts_with("zero:1: this line is longer than 64 MB")) << why;
}

TEST(TextLines, HaveALimitWhereTheyAreTooMany) {
  std::istringstream in("one\ntwo\nthree\n");
  std::string line;
  TextLines all(in, "text", 14);
  while (all.next(line)) continue;
  EXPECT_EQ(all.origin().line, 3);
  in = std::istringstream("one\ntwo\nthree\n");
  TextLines lines(in, "text", 13);
  EXPECT_TRUE(lines.next(line));
  EXPECT_TRUE(lines.next(line));
  EXPECT_EQ(tests::complaint_of([&] { lines.next(line); }),
            "text:3: here the file holds more than 13 bytes, which is the most that is read; name "
            "another file, or cut this one");
}

}  // namespace
}  // namespace shoal
