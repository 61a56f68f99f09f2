#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shoal::program {

/// The folder that holds the Python package, of the build or as installed; "" if it was not built.
std::filesystem::path package_path();

/// Becomes Python with these arguments, which finds the package if there is one; `purpose`
/// completes "which ..." if there is none. Throws SystemError.
[[noreturn]] void become_python(const std::string& purpose,
                                const std::vector<std::string>& arguments);

/// The same in a child process, whose output is left out and whose messages are shown: whether it
/// ended well.
bool python_succeeds(const std::string& purpose, const std::vector<std::string>& arguments);

}  // namespace shoal::program
