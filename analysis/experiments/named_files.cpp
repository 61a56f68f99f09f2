#include "shoal/analysis/experiments/named_files.hpp"

#include <algorithm>
#include <vector>

#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

bool is_shipped(const std::vector<std::string>& names, const std::string& name) {
  return !fs::exists(name) && std::ranges::find(names, name) != names.end();
}

/// A base and what is varied, which no scenario has.
bool varies_a_base(const Setting& root) {
  return root.find("group") || root.find("factor") ||
         (root.find("scenario") && looks_like_a_study(root));
}

/// Tables of a scenario, and nothing of a study.
bool has_scenario_tables(const Setting& root) {
  const Schema& scenario = schema_of<scenarios::Scenario>();
  return !looks_like_a_study(root) && std::ranges::any_of(root.table(), [&](const auto& entry) {
    return scenario.find(entry.first) != nullptr;
  });
}

}  // namespace

void require_no_claims(const Setting& root, const fs::path& file) {
  if (!root.find("claim") || root.find("scenario")) return;
  throw InputError({file.string(), 0}, "this is a file of claims; name it in a study (claims = \"" +
                                           file.filename().string() +
                                           "\"), which shoal sweep runs and shoal claims "
                                           "answers");
}

fs::path scenario_file(const std::string& name_or_path) {
  if (is_shipped(library_studies(), name_or_path)) {
    throw InputError('"' + name_or_path + "\" is a study; shoal sweep " + name_or_path +
                     " runs its trials");
  }
  fs::path file = scenarios::find_scenario(name_or_path);
  const Setting root = scenarios::read_toml(file);
  require_no_claims(root, file);
  if (varies_a_base(root)) {
    throw InputError({file.string(), 0}, "this is a study; shoal sweep runs its trials");
  }
  return file;
}

fs::path study_file(const std::string& name_or_path) {
  if (is_shipped(scenarios::library_scenarios(), name_or_path)) {
    throw InputError('"' + name_or_path + "\" is a scenario; shoal run " + name_or_path +
                     " runs it");
  }
  fs::path file = find_study(name_or_path);
  const Setting root = scenarios::read_toml(file);
  require_no_claims(root, file);
  if (has_scenario_tables(root)) {
    throw InputError({file.string(), 0}, "this is a scenario; shoal run runs it");
  }
  return file;
}

}  // namespace shoal::analysis
