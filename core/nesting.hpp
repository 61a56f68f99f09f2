#pragma once

#include <cstddef>

namespace shoal {

/// How deep tables and lists of settings may be nested: far deeper than any option is, and far less
/// than what walking through a tree by recursion can bear.
inline constexpr std::size_t deepest_nesting = 100;

}  // namespace shoal
