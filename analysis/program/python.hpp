#pragma once

#include <string>
#include <vector>

namespace shoal::program {

/// Becomes Python with these arguments; `purpose` completes "which ..." if there is none. Throws
/// SystemError.
[[noreturn]] void become_python(const std::string& purpose, const std::vector<std::string>& arguments);

}  // namespace shoal::program
