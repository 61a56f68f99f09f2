// What `--set` takes: one assignment, put into a scenario.

#include "fuzzed.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  Setting root = scenarios::parse_toml("[swarm]\n[plan]\n", "scenario.toml");
  scenarios::apply_set(root, std::string(input));
  scenarios::read_scenario(root);
}
