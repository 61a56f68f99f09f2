#include "commands.hpp"
#include "python.hpp"
#include "shoal/scenarios/library_path.hpp"

namespace shoal::program {

void figures(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{(scenarios::library_path() / "figures").string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  become_python("draws the figures", words);
}

}  // namespace shoal::program
