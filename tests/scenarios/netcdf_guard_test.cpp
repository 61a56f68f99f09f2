#include "shoal/scenarios/netcdf_guard.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "tests/support/complaint_of.hpp"

namespace shoal::scenarios {
namespace {

using tests::complaint_of;

std::string complaint_of_rehearsal(const std::function<void()>& read) {
  return complaint_of([&] { rehearse_netcdf("some.nc", 1000, read); });
}

TEST(NetcdfRehearsal, LeavesNothingOfWhatWasRead) {
  int reads = 0;
  EXPECT_EQ(complaint_of_rehearsal([&] { ++reads; }), "");
  EXPECT_EQ(reads, 0);
}

TEST(NetcdfRehearsal, LeavesExceptionsToTheReadingThatFollows) {
  EXPECT_EQ(complaint_of_rehearsal([] { throw std::runtime_error("no such variable"); }), "");
  EXPECT_EQ(complaint_of_rehearsal([] { throw InputError("a wind is no current"); }), "");
}

TEST(NetcdfRehearsal, SurvivesACrash) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGKILL}) {
    const std::string why = complaint_of_rehearsal([&] { std::raise(signal); });
    EXPECT_TRUE(why.starts_with("some.nc: is damaged: the netCDF library crashes")) << why;
  }
}

TEST(NetcdfRehearsal, EndsALoopAndCallsNothingSlowDamaged) {
  // What the kernel sends to a process that has used up its time.
  const std::string why = complaint_of_rehearsal([] { std::raise(SIGXCPU); });
  EXPECT_TRUE(why.starts_with("some.nc: cannot be read within 30 s: ")) << why;
  EXPECT_NE(why.find("; cut it to the region and the times"), std::string::npos) << why;
  EXPECT_EQ(why.find("damaged"), std::string::npos) << why;
}

TEST(NetcdfRehearsal, BeginsAgainWhereAChildIsBlocked) {
  // As by a lock that another thread held when the child was forked: the first child only.
  void* const shared =
      ::mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  int& children = *static_cast<int*>(shared);
  EXPECT_EQ(complaint_of_rehearsal([&] {
              if (++children == 1) ::pause();
            }),
            "");
  EXPECT_EQ(children, 2);
  ::munmap(shared, sizeof(int));
}

TEST(NetcdfRehearsal, RefusesMoreMemoryThanTheFileCanFill) {
  // Freed unread memory could be optimised away. A sanitizer ends the process instead of throwing.
  const std::string why =
      complaint_of_rehearsal([] { std::vector<char>(std::size_t{4} << 30).front() = 1; });
  EXPECT_TRUE(why.starts_with("some.nc: is damaged: ")) << why;
}

TEST(NetcdfRehearsal, MayUseTheGuard) {
  EXPECT_EQ(complaint_of_rehearsal([] { const NetcdfGuard guard; }), "");
  const NetcdfGuard guard;  // and it is free afterwards
}

}  // namespace
}  // namespace shoal::scenarios
