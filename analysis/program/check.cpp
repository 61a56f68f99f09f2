#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "shoal/analysis/experiments/named_files.hpp"
#include "shoal/analysis/experiments/pipeline.hpp"
#include "shoal/analysis/experiments/study/cell_scenarios.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/analysis/tables/table.hpp"
#include "shoal/core/csv_table.hpp"
#include "shoal/core/text.hpp"
#include "shoal/scenarios/currents/netcdf_report.hpp"
#include "shoal/scenarios/currents/netcdf_statistics.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::program {
namespace {

namespace fs = std::filesystem;

void check_scenario(const fs::path& file) {
  scenarios::TomlFiles files;
  const scenarios::Inheritance whole = scenarios::with_inherited(scenarios::read_toml(file), files);
  const scenarios::Scenario scenario = scenarios::read_scenario(whole.settings);
  const scenarios::World world(scenario);  // opens and checks all that it names
  analysis::require_holdable(world, true);
  fmt::print("{}: a scenario of {} vehicles, {}, plan {}, current {}, {:g} s\n", file.string(),
             world.size(), scenario.behaviour.kind(), scenario.plan.kind(), scenario.current.kind(),
             scenario.trial.duration_s);
  for (const fs::path& inherited : whole.files) fmt::print("  inherits {}\n", inherited.string());
}

/// Everything that a sweep would refuse before its trials, and the world of a cell of each group.
void check_study(const fs::path& file) {
  const auto [list, tables] = analysis::planned_study(scenarios::read_toml(file));
  analysis::CellScenarios scenarios(list);
  for (std::size_t g = 0; g < list.groups().size(); ++g) {
    for (std::size_t cell = list.groups()[g].cells(); cell-- > 0;) {
      const scenarios::Scenario scenario = scenarios.of(g, cell).scenario;
      if (cell == 0) analysis::require_holdable(scenarios::World(scenario), false);
    }
  }
  std::size_t cells = 0;
  for (const analysis::TrialGroup& group : list.groups()) cells += group.cells();
  fmt::print("{}: a study of {} trials in {} cells; tables: {}, claims: {}\n", file.string(),
             list.trials(), cells, tables, list.study().claims.claims.size());
  for (const analysis::TrialGroup& group : list.groups()) {
    std::string factors;
    for (const analysis::Axis& axis : group.axes()) {
      factors += (factors.empty() ? "" : " x ") + axis.name();
      if (axis.levels() > 0) factors += fmt::format(" ({})", axis.levels());
    }
    const std::string name = group.name().empty() ? group.group().scenario : group.name();
    fmt::print("  {:<20} {:>6} cells x {:>3} replications, {}{}{}\n", name, group.cells(),
               group.replications(), group.group().design.kind(), factors.empty() ? "" : ": ",
               factors);
  }
}

void check_toml(const fs::path& file) {
  const Setting root = scenarios::read_toml(file);
  analysis::require_no_claims(root, file);
  const bool study = analysis::looks_like_a_study(root);
  study ? check_study(file) : check_scenario(file);
}

/// A file, or the scenario, study or set of that name that ships.
fs::path named(const std::string& name) {
  if (fs::exists(name)) return name;
  std::vector<std::string> known = scenarios::library_scenarios();
  const std::vector<std::string> studies = analysis::library_studies();
  const std::vector<std::string> sets = scenarios::library_sets();
  if (std::ranges::find(known, name) != known.end()) return scenarios::find_scenario(name);
  if (std::ranges::find(studies, name) != studies.end()) return analysis::find_study(name);
  if (std::ranges::find(sets, name) != sets.end()) return scenarios::set_file(name);
  known.insert(known.end(), studies.begin(), studies.end());
  known.insert(known.end(), sets.begin(), sets.end());
  throw InputError("there is no file \"" + name +
                   "\", and no scenario, study or set of that name ships" +
                   suggestion(name, known));
}

void check_csv(const fs::path& file) {
  const CsvTable table({file, {}},
                       {.required = {"name", "x_m", "y_m"}, .optional = {"heading_deg"}});
  std::vector<Eigen::Vector2d> slots;
  const std::vector<double> x = table.numbers("x_m");
  const std::vector<double> y = table.numbers("y_m");
  for (std::size_t i = 0; i < table.rows(); ++i) slots.emplace_back(x[i], y[i]);
  if (table.has("heading_deg")) table.numbers("heading_deg");
  const formations::Plan plan(table.texts("name"), std::move(slots), {file.string(), 0});
  fmt::print("{}: {} of {} vehicles\n", file.string(),
             table.has("heading_deg") ? "starts" : "a plan, or starts,", plan.size());
}

/// What the currents of some files are like where a formation would drift, side by side. A file
/// without such statistics gets a note instead.
void compare_currents(const std::vector<fs::path>& files) {
  analysis::Table table{.name = "currents",
                        .caption = "",
                        .columns = {{.header = "where a formation drifts"}, {.header = "meaning"}},
                        .rows = {},
                        .notes = {}};
  for (const fs::path& file : files) {
    try {
      const auto statistics = scenarios::current_file_statistics(file);
      table.columns.push_back({.header = file.string()});
      table.rows.resize(statistics.size());
      for (std::size_t i = 0; i < statistics.size(); ++i) {
        const auto& [name, meaning, value] = statistics[i];
        std::vector<analysis::Cell>& row = table.rows[i];
        if (row.empty()) row = {name, meaning};
        row.push_back(value ? analysis::Cell(analysis::Estimate{
                                  .value = *value, .digits = analysis::Digits::significant(6)})
                            : analysis::Missing{});
      }
    } catch (const InputError& error) {
      table.notes.push_back(std::string("no statistics: ") + error.what());
    }
  }
  if (!files.empty()) fmt::print("\n{}", analysis::as_text(table));
}

}  // namespace

void check(const std::vector<std::string>& files) {
  std::vector<fs::path> currents;
  for (const std::string& name : files) {
    const std::string extension = fs::path(name).extension();
    if (extension == ".toml" || (extension.empty() && !fs::exists(name))) {
      check_toml(named(name));
    } else if (extension == ".csv") {
      check_csv(name);
    } else if (extension == ".nc") {
      const fs::path file = scenarios::resolved({name, {}});
      fmt::print("{}", scenarios::describe_current_file(file));
      if (std::ranges::find(currents, file) == currents.end()) currents.push_back(file);
    } else {
      throw InputError(name + ": shoal checks .toml, .csv and .nc files");
    }
  }
  compare_currents(currents);
}

}  // namespace shoal::program
