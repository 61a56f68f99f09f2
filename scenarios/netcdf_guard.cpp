#include "shoal/scenarios/netcdf_guard.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>

#include "shoal/core/error.hpp"

namespace shoal::scenarios {
namespace {

std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

constexpr rlim_t megabyte = 1U << 20;

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlim_t soft = std::min(most, now.rlim_max);
  const rlimit then{soft, now.rlim_max};
  ::setrlimit(resource, &then);
}

rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// In the child: a crash is no news to anybody but its parent.
void be_expendable(std::uintmax_t bytes) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  // 10 MB a second is slow even for compressed files. No compression of netCDF's makes more than a
  // thousand bytes of one.
  limit(RLIMIT_CPU, 5 + bytes / (10 * megabyte));
  limit(RLIMIT_AS, address_space() + 512 * megabyte + 2000 * bytes);
}

}  // namespace

NetcdfGuard::NetcdfGuard() : lock_(netcdf_mutex()) {
  // Each thread has an error handler of its own, which prints unless it is removed.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void rehearse_netcdf(const std::string& name, std::uintmax_t bytes,
                     const std::function<void()>& read) {
  std::unique_lock lock(netcdf_mutex());  // the child must not begin in the middle of a reading
  const pid_t child = ::fork();
  if (child == 0) {
    be_expendable(bytes);
    lock.unlock();
    try {
      read();
    } catch (...) {  // NOLINT(bugprone-empty-catch): the reading that follows throws it again
    }
    ::_exit(0);
  }
  lock.unlock();
  if (child < 0) return;  // no process to spare: read without
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return;  // its status goes elsewhere
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw InputError(
      name + ": is damaged: the netCDF library " +
      (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU ? "does not come to an end" : "crashes") +
      " reading it; get the file again, or write it anew");
}

}  // namespace shoal::scenarios
