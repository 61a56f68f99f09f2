#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "commands.hpp"
#include "shoal/core/error.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::program {

void figures(const std::vector<std::string>& arguments) {
  // Debian's Python, which has Debian's matplotlib, also where another one comes first.
  const char* given = std::getenv("SHOAL_PYTHON");
  std::string python = given && *given ? given : "/usr/bin/python3";
  // -B: nothing is written into an installed library.
  std::vector<std::string> words{python, "-B", (scenarios::library_path() / "figures").string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(python.c_str(), pointers.data());
  throw SystemError("cannot run " + python + " (" + std::strerror(errno) +
                    "), which draws the figures; install python3, or set SHOAL_PYTHON");
}

}  // namespace shoal::program
