#include <fmt/core.h>

#include <filesystem>

#include "commands.hpp"
#include "shoal/formations/csv_table.hpp"
#include "shoal/scenarios/currents/netcdf_report.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::program {
namespace {

namespace fs = std::filesystem;

void check_scenario(const fs::path& file) {
  const scenarios::Scenario scenario = scenarios::read_scenario(scenarios::read_toml(file));
  const scenarios::World world(scenario);  // opens and checks all that it names
  fmt::print("{}: a scenario of {} vehicles, {}, plan {}, current {}, {:g} s\n", file.string(),
             world.size(), scenario.behaviour.kind(), scenario.plan.kind(), scenario.current.kind(),
             scenario.trial.duration_s);
}

void check_csv(const fs::path& file) {
  const formations::CsvTable table(
      {file, {}}, {.required = {"name", "x_m", "y_m"}, .optional = {"heading_deg"}});
  std::vector<Eigen::Vector2d> slots;
  const std::vector<double> x = table.numbers("x_m");
  const std::vector<double> y = table.numbers("y_m");
  for (std::size_t i = 0; i < table.rows(); ++i) slots.emplace_back(x[i], y[i]);
  if (table.has("heading_deg")) table.numbers("heading_deg");
  const formations::Plan plan(table.texts("name"), std::move(slots), {file.string(), 0});
  fmt::print("{}: {} of {} vehicles\n", file.string(),
             table.has("heading_deg") ? "starts" : "a plan, or starts,", plan.size());
}

}  // namespace

void check(const std::vector<std::string>& files) {
  for (const std::string& name : files) {
    const std::string extension = fs::path(name).extension();
    if (extension == ".toml" || (extension.empty() && !fs::exists(name))) {
      check_scenario(scenarios::find_scenario(name));
    } else if (extension == ".csv") {
      check_csv(name);
    } else if (extension == ".nc") {
      fmt::print("{}", scenarios::describe_current_file(name));
    } else {
      throw InputError(name + ": shoal checks .toml, .csv and .nc files");
    }
  }
}

}  // namespace shoal::program
