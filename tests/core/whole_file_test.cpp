#include "shoal/core/whole_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <future>

#include "shoal/core/error.hpp"
#include "tests/support/complaint_of.hpp"

namespace shoal {
namespace {

namespace fs = std::filesystem;

class WholeFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      found.push_back(entry.path().filename());
    }
    std::ranges::sort(found);
    return found;
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("shoal_whole_" + std::to_string(::getpid()));
  std::string text_ = "all of it\n";
};

TEST_F(WholeFile, ReplacesAFileAndLeavesNothingElse) {
  write_whole_file(folder_ / "a", std::string("old and longer\n"));
  write_whole_file(folder_ / "a", text_);
  EXPECT_EQ(read_whole_file(folder_ / "a"), text_);
  EXPECT_EQ(names(), std::vector<std::string>{"a"});
}

TEST_F(WholeFile, KeepsALinkAndReplacesWhatItLeadsTo) {
  fs::create_directory(folder_ / "below");
  write_whole_file(folder_ / "below/target", std::string("old"));
  fs::create_symlink("below/target", folder_ / "link");
  fs::create_symlink("link", folder_ / "link_to_link");
  fs::create_symlink("below/new", folder_ / "leads_nowhere");
  write_whole_file(folder_ / "link_to_link", text_);
  write_whole_file(folder_ / "leads_nowhere", text_);
  EXPECT_EQ(read_whole_file(folder_ / "below/target"), text_);
  EXPECT_EQ(read_whole_file(folder_ / "below/new"), text_);
  for (const char* link : {"link", "link_to_link", "leads_nowhere"}) {
    EXPECT_TRUE(fs::is_symlink(folder_ / link)) << link;
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"below", "leads_nowhere", "link", "link_to_link"}));
}

TEST_F(WholeFile, IsNothingWhereThereIsNoneOrAFolder) {
  fs::create_directory(folder_ / "below");
  EXPECT_EQ(read_whole_file(folder_ / "below"), std::nullopt);
  EXPECT_EQ(read_whole_file(folder_ / "none"), std::nullopt);
  write_whole_file(folder_ / "empty", std::string());
  EXPECT_EQ(read_whole_file(folder_ / "empty"), "");
}

TEST_F(WholeFile, IsReadByteForByte) {
  const std::string bytes("a\0b\r\n\xff", 6);
  write_whole_file(folder_ / "a", bytes);
  EXPECT_EQ(read_whole_file(folder_ / "a"), bytes);
}

TEST_F(WholeFile, IsReadUpToALimitWhichAFileWithoutAnEndExceeds) {
  write_whole_file(folder_ / "a", text_);
  EXPECT_EQ(read_whole_file(folder_ / "a", text_.size()), text_);
  EXPECT_THROW(read_whole_file(folder_ / "a", text_.size() - 1), InputError);
  EXPECT_EQ(tests::complaint_of([] { read_whole_file("/dev/zero"); }),
            "/dev/zero: the file holds more than 64 MB, which is the most that is read; name "
            "another file, or cut this one");
}

TEST_F(WholeFile, WritesIntoAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  auto got = std::async(std::launch::async, [&] { return read_whole_file(pipe); });
  write_whole_file(pipe, text_);
  EXPECT_EQ(got.get(), text_);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(WholeFile, WritesToADevice) {
  EXPECT_NO_THROW(write_whole_file("/dev/null", text_));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(write_whole_file("/dev/full", text_), SystemError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WholeFile, LeavesTheOldFileIfItCannotBeReplaced) {
  fs::create_directories(folder_ / "taken/by_another");
  EXPECT_THROW(write_whole_file(folder_ / "taken", text_), SystemError);
  EXPECT_THROW(write_whole_file(folder_ / "missing/a", text_), SystemError);
  fs::create_symlink("loop", folder_ / "loop");
  EXPECT_THROW(write_whole_file(folder_ / "loop", text_), SystemError);
  EXPECT_EQ(names(), (std::vector<std::string>{"loop", "taken"}));
}

}  // namespace
}  // namespace shoal
