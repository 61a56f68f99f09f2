// OpenBLAS, which Ipopt and Ceres may bring along, starts a thread for every core as it is loaded,
// and waits at the end for those that memory limits kept from starting. All problems here are
// small: one thread is right, and it has to be asked for before the library is loaded. So the
// program starts itself once more, with the variable set, before any library is initialised.

#include <unistd.h>

#include <array>
#include <cstddef>

namespace {

constexpr char variable[] = "OPENBLAS_NUM_THREADS=";
constexpr char setting[] = "OPENBLAS_NUM_THREADS=1";

bool sets_threads(const char* entry) {
  for (std::size_t i = 0; variable[i] != 0; ++i) {
    if (entry[i] != variable[i]) return false;
  }
  return true;
}

// Neither the C library nor a sanitizer is initialised here.
__attribute__((no_sanitize("address", "undefined", "thread"))) void start_with_one_thread(
    int, char** argv, char** environment) {
  std::array<char*, 4096> extended;
  std::size_t count = 0;
  for (; environment[count]; ++count) {
    if (count + 2 >= extended.size() || sets_threads(environment[count])) return;
    extended[count] = environment[count];
  }
  extended[count] = const_cast<char*>(setting);
  extended[count + 1] = nullptr;
  ::execve("/proc/self/exe", argv, extended.data());
}

__attribute__((section(".preinit_array"),
               used)) void (*const before_libraries)(int, char**, char**) = start_with_one_thread;

}  // namespace
