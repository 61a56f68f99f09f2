// A plan in CSV.

#include "fuzzed.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  Setting root = scenarios::parse_toml("plan.kind = \"file\"", "scenario.toml");
  scenarios::apply_set(root, "plan.file.path=" + tests::fuzzed_file("plan.csv", input).string());
  scenarios::read_scenario(root).plan.make()->plan();
}
