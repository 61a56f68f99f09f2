// A file of claims.

#include "fuzzed.hpp"
#include "shoal/analysis/experiments/claims/claim_request.hpp"
#include "shoal/scenarios/toml_file.hpp"

using namespace shoal;

FUZZ(const std::string_view input) {
  analysis::read_claims(scenarios::parse_toml(std::string(input), "claims.toml"));
}
