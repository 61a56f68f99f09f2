// A scenario as `shoal check FILE` reads it: TOML, what it inherits, options, and the files it
// names.

#include "fuzzed.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto file = tests::fuzzed_file("scenario.toml", input);
  scenarios::TomlFiles files;
  const auto whole = scenarios::with_inherited(scenarios::read_toml(file), files);
  const scenarios::World world(scenarios::read_scenario(whole.settings));
}
