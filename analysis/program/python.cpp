#include "python.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "shoal/core/error.hpp"
#include "shoal/core/message.hpp"
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

bool python_succeeds(const std::string& purpose, const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child < 0) throw SystemError(std::string("cannot start Python: ") + std::strerror(errno));
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
    try {
      become_python(purpose, arguments);
    } catch (const std::exception& error) {
      write_message("shoal: " + std::string(error.what()) + "\n");
    }
    std::_Exit(1);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace shoal::program
