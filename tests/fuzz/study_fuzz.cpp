// A study as `shoal sweep` and `shoal check` read it, up to the question whether its tables can be
// answered.

#include "fuzzed.hpp"
#include "shoal/analysis/experiments/results/study_tables.hpp"
#include "shoal/scenarios/toml_file.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  const auto file = tests::fuzzed_file("study.toml", input);
  const analysis::TrialList list(analysis::read_study(scenarios::read_toml(file)));
  analysis::require_answerable(list);
}
