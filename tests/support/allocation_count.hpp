#pragma once

#include <cstddef>

// The sanitizers have an operator new and a malloc of their own: under them nothing is counted.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // g++
#define SHOAL_SANITIZED
#elif defined(__has_feature)  // clang++
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SHOAL_SANITIZED
#endif
#endif

namespace shoal::tests {

/// How often this thread has asked operator new for memory so far.
///
/// Programs that link allocation_count.cpp have their operator new and delete replaced, also for
/// the shared libraries that they load. Always 0 under a sanitizer.
std::size_t allocations() noexcept;

/// The same of malloc, which Eigen calls itself; operator new calls it, too.
std::size_t heap_requests() noexcept;

}  // namespace shoal::tests
