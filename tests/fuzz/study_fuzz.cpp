// A study as `shoal sweep` and `shoal check` read it, up to the question whether its tables can be
// answered.

#include "fuzzed.hpp"
#include "shoal/analysis/experiments/pipeline.hpp"
#include "shoal/scenarios/toml_file.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto file = tests::fuzzed_file("study.toml", input);
  analysis::planned_study(scenarios::read_toml(file));
}
