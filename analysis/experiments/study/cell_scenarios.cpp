#include "shoal/analysis/experiments/study/cell_scenarios.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fstream>
#include <iterator>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    throw InputError(file.string() +
                     " is no regular file; the trials of a study read it again and again");
  }
  std::ifstream in(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw SystemError("cannot read " + file.string() + "; check its permissions");
  return content;
}

template <class Family>
std::optional<std::string> waits(const Option& option, const Setting& choice) {
  const auto& registry = Registry<Family>::instance();
  if (option.choice != &registry) return std::nullopt;
  const auto& kind = std::get<std::string>(choice.find("kind")->value);
  const Setting* table = choice.find_path(kind);
  return registry.make(kind, table ? *table : Setting{}, kind)->one_at_a_time();
}

}  // namespace

fs::path base_scenario(const std::string& name, const Origin& origin) {
  if (origin.line > 0 && fs::path(name).is_relative()) {
    const fs::path beside = fs::path(origin.file).parent_path() / name;
    std::error_code ignored;
    if (fs::is_regular_file(beside, ignored)) return fs::absolute(beside).lexically_normal();
  }
  try {
    return scenarios::find_scenario(name);
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
}

const std::string& CellScenarios::content_hash(const FilePath& file) {
  const fs::path path = scenarios::resolved(file);
  const auto known = content_hashes_.find(path.string());
  if (known != content_hashes_.end()) return known->second;
  return content_hashes_.emplace(path.string(), hash_of(content_of(path))).first->second;
}

CellScenario CellScenarios::of(std::size_t group_index, std::size_t cell) {
  const TrialGroup& planned = list_.groups()[group_index];
  const Group& group = planned.group();
  const std::vector<Axis::Place> changes = planned.changes(cell);
  std::string name = group.scenario;
  Origin origin = group.origin;
  for (const Axis::Place& change : changes) {
    if (change.scenario.empty()) continue;
    name = change.scenario;
    origin = change.set.origin;
  }
  CellScenario made;
  try {
    Setting root = files_.at(base_scenario(name, origin));
    const auto change_to = [&root](const Setting& set) {
      scenarios::require_no_scenario_left_out(root, set);
      overlay(root, set);
    };
    change_to(list_.study().set);
    change_to(group.set);
    for (const Axis::Place& change : changes) change_to(change.set);
    root = scenarios::with_inherited(std::move(root), files_).settings;
    made.scenario = scenarios::read_scenario(root);
  } catch (const InputError& error) {
    const std::string title = planned.title(cell);
    throw InputError(error.what() +
                     (title.empty() ? std::string() : " (in the cell " + title + ")"));
  }
  made.scenario.trial.seed = 0;
  made.scenario.trial.record_every_s = 0.0;

  Setting written = scenarios::resolved_scenario(made.scenario);
  // Why a trial fails must not depend on where it runs: the lines of files are known here only.
  made.scenario = scenarios::read_scenario(written);
  visit_options(schema_of<scenarios::Scenario>(), written,
                [&](const Option& option, Setting& value) {
                  if (option.choice && !made.one_at_a_time) {
                    made.one_at_a_time = waits<solvers::Solver>(option, value);
                    if (!made.one_at_a_time)
                      made.one_at_a_time = waits<solvers::RegistrationSolver>(option, value);
                  }
                  if (!option.is_file) return;
                  const auto& file = std::get<std::string>(value.value);
                  if (!file.empty()) value.value = content_hash({file, group.origin});
                });
  made.identity = hash_of(to_toml(written));
  return made;
}

CellScenario CellScenarios::of(const ListedTrial& trial) {
  CellScenario made = of(trial.group, trial.cell);
  made.scenario.trial.seed = list_.seed(trial);
  return made;
}

std::string trial_identity(const std::string& cell_identity, std::int64_t seed) {
  return hash_of(cell_identity + " " + std::to_string(seed) + " " + build_info().program);
}

std::string hash_of(const std::string& text) {
  // A UUID of version 5 is a truncated SHA-1 of a name within a name space; ours is fixed.
  static const boost::uuids::name_generator_sha1 generator(boost::uuids::ns::oid());
  return to_string(generator(text.data(), text.size()));
}

}  // namespace shoal::analysis
