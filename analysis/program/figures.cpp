#include "commands.hpp"
#include "python.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::program {

namespace {

std::vector<std::string> drawing(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{figures_package()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

constexpr const char* purpose = "draws the figures";

}  // namespace

std::string figures_package() {
  return (scenarios::library_path() / "figures").string();
}

void figures(const std::vector<std::string>& arguments) {
  become_python(purpose, drawing(arguments));
}

bool figures_drawn(const std::string& folder) {
  return python_succeeds(purpose, drawing({folder}));
}

}  // namespace shoal::program
