#include "shoal/scenarios/netcdf_guard.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <new>
#include <thread>

#include "shoal/core/error.hpp"

namespace shoal::scenarios {
namespace {

std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

constexpr rlim_t megabyte = 1U << 20;
constexpr int out_of_memory = 2;

/// What a reading may take. 10 MB a second is slow even for compressed files; what is not stored,
/// as missing values need not be, takes its time too.
rlim_t most_seconds(std::uintmax_t bytes) {
  return 30 + bytes / (10 * megabyte);
}

/// What a child that did not end well says of the file.
std::string fault_of(int status, std::uintmax_t bytes) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    return "cannot be read within " + std::to_string(most_seconds(bytes)) +
           " s: it holds too much, or the netCDF library does not come to an end; cut it to the "
           "region and the times that are needed, or write it anew";
  }
  const bool memory = WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory;
  return std::string("is damaged: ") +
         (memory ? "it claims to hold more than a file of its size can"
                 : "the netCDF library crashes reading it") +
         "; get the file again, or write it anew";
}

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit now{};
  ::getrlimit(resource, &now);
  const rlimit then{std::min(most, now.rlim_cur), now.rlim_max};
  ::setrlimit(resource, &then);
}

rlim_t address_space() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// Of the child: its crash is silent, and only its parent learns of it by the status.
void be_expendable(std::uintmax_t bytes) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, most_seconds(bytes));
  // No compression of netCDF's makes more than a thousand bytes of one.
  limit(RLIMIT_AS, address_space() + 512 * megabyte + most_netcdf_bytes + 2000 * bytes);
}

double cpu_s(clockid_t clock) {
  timespec used{};
  ::clock_gettime(clock, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// Waits for a child. One that does nothing for seconds waits for a lock that another thread held
/// when it was forked (of a memory allocator, say): that is no fault of the file's, and it is
/// ended. False then.
bool ended_by_itself(pid_t child, int& status) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds patience(5);
  clockid_t clock{};
  const bool timed = ::clock_getcpuclockid(child, &clock) == 0;
  double used_s = -1.0;
  Clock::time_point since = Clock::now();
  for (std::chrono::milliseconds pause(1);;) {
    const pid_t done = ::waitpid(child, &status, WNOHANG);
    if (done == child) return true;
    if (done < 0 && errno != EINTR) {
      status = 0;  // it goes elsewhere
      return true;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(20));
    const double now_s = timed ? cpu_s(clock) : 0.0;
    if (now_s != used_s) {
      used_s = now_s;
      since = Clock::now();
    } else if (Clock::now() - since > patience) {
      ::kill(child, SIGKILL);
      while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
      return false;
    }
  }
}

/// A child that reads, and ends; negative if there is no process to spare.
pid_t forked(std::uintmax_t bytes, const std::function<void()>& read) {
  std::unique_lock lock(netcdf_mutex());  // the child must not begin in the middle of a reading
  const pid_t child = ::fork();
  if (child != 0) return child;
  be_expendable(bytes);
  lock.unlock();
  try {
    read();
  } catch (const std::bad_alloc&) {
    ::_exit(out_of_memory);
  } catch (...) {  // NOLINT(bugprone-empty-catch): the reading that follows throws it again
  }
  ::_exit(0);
}

}  // namespace

NetcdfGuard::NetcdfGuard() : lock_(netcdf_mutex()) {
  // Each thread has an error handler of its own, which prints unless it is removed.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void rehearse_netcdf(const std::string& name, std::uintmax_t bytes,
                     const std::function<void()>& read) {
  constexpr int tries = 3;
  for (int i = 0; i < tries; ++i) {
    const pid_t child = forked(bytes, read);
    if (child < 0) return;  // read without
    int status = 0;
    if (!ended_by_itself(child, status)) continue;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    throw InputError(name + ": " + fault_of(status, bytes));
  }
}

}  // namespace shoal::scenarios
