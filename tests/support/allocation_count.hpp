#pragma once

#include <cstddef>

namespace shoal::tests {

/// How often this thread has asked operator new for memory so far.
///
/// Programs that link allocation_count.cpp have their operator new and delete replaced, also for
/// the shared libraries that they load. Always 0 under a sanitizer.
std::size_t allocations() noexcept;

/// The same of malloc, which Eigen calls itself; operator new calls it, too.
std::size_t heap_requests() noexcept;

}  // namespace shoal::tests
