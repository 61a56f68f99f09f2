#pragma once

#include <map>
#include <optional>
#include <string>

#include "shoal/analysis/experiments/study/trial_list.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

/// The scenario of a cell, and what tells it from every other.
struct CellScenario {
  scenarios::Scenario scenario;  ///< without a seed of its own, and not recorded
  /// A hash of all that the numbers of its trials depend on, but for seed and program: the resolved
  /// scenario, with the content of the files it names in place of their names.
  std::string identity;
  /// Why trials of it wait for one another in the threads of one process, or nothing.
  std::optional<std::string> one_at_a_time;
};

/// Makes the scenarios of a study's cells from their bases.
class CellScenarios {
 public:
  explicit CellScenarios(const TrialList& list) : list_(list) {}

  /// Throws InputError, naming the cell, if a base is missing or its scenario cannot be run.
  CellScenario of(std::size_t group, std::size_t cell);

  /// The same with the seed of a trial.
  CellScenario of(const ListedTrial& trial);

 private:
  const std::string& content_hash(const FilePath& file);

  const TrialList& list_;
  scenarios::TomlFiles files_;  // of one state: an edit in mid-way does not change a sweep
  std::map<std::string, std::string> content_hashes_;
};

/// The file of a base scenario: relative to the file that names it, or a name of the library.
/// Throws InputError.
std::filesystem::path base_scenario(const std::string& name, const Origin& origin);

/// What tells one trial from every other: its cell, its seed, and the program that runs it.
std::string trial_identity(const std::string& cell_identity, std::int64_t seed);

/// A hash of any text; equal texts have equal hashes on every machine.
std::string hash_of(const std::string& text);

}  // namespace shoal::analysis
