#include "python.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "shoal/core/error.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::program {

std::filesystem::path package_path() {
  const auto prefix = scenarios::library_path().parent_path().parent_path().parent_path();
  for (const auto& candidate : {prefix / "python", prefix / SHOAL_PYTHON_DIR}) {
    if (std::filesystem::exists(candidate / "shoal")) return candidate;
  }
  return {};
}

void become_python(const std::string& purpose, const std::vector<std::string>& arguments) {
  // Debian's Python, which has Debian's packages, also where another one comes first.
  const char* given = std::getenv("SHOAL_PYTHON");
  const std::string python = given && *given ? given : "/usr/bin/python3";
  if (const std::string package = package_path().string(); !package.empty()) {
    const char* others = std::getenv("PYTHONPATH");
    ::setenv("PYTHONPATH", (package + (others ? ":" + std::string(others) : "")).c_str(), 1);
  }
  // -B: nothing is written into an installed library.
  std::vector<std::string> words{python, "-B"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(python.c_str(), pointers.data());
  throw SystemError("cannot run " + python + " (" + std::strerror(errno) + "), which " + purpose +
                    "; install python3, or set SHOAL_PYTHON");
}

}  // namespace shoal::program
