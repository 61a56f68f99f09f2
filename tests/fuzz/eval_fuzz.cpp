// A table for `shoal eval`; the first byte chooses the model.

#include "fuzzed.hpp"
#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/core/registry.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  if (input.empty()) return;
  const auto& members = Registry<analysis::Evaluation>::instance().members();
  const auto& model = members[static_cast<unsigned char>(input[0]) % members.size()];
  analysis::evaluated(model.name, tests::fuzzed_file("rows.csv", input.substr(1)).string());
}
