#pragma once

#include <string>
#include <vector>

#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::tests {

/// A scenario of the given `key=value` settings.
inline scenarios::Scenario scenario_of(const std::vector<std::string>& sets) {
  Setting root;
  for (const std::string& set : sets) scenarios::apply_set(root, set);
  return scenarios::read_scenario(root);
}

}  // namespace shoal::tests
