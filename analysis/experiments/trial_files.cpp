#include <nlohmann/json.hpp>

#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/cf_unit.hpp"
#include "shoal/analysis/experiments/trial.hpp"
#include "shoal/core/whole_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_text(const fs::path& file, const std::string& text) {
  write_whole_file(file, text);
}

std::vector<scenarios::Series> in_cf_units(std::vector<scenarios::Series> series) {
  for (scenarios::Series& each : series) each.unit = cf_unit(each.unit);
  return series;
}

}  // namespace

void require_writable(const fs::path& folder, const std::string& remedy) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed && !fs::is_directory(folder)) {
    failed = std::make_error_code(std::errc::not_a_directory);
  }
  if (failed) {
    throw SystemError("cannot write into " + folder.string() + ": " + failed.message() + "; " +
                      remedy);
  }
  // Permissions do not tell all: a file system may be read-only, full, or none that holds files.
  const fs::path probe = folder / ".shoal";
  write_text(probe, "can files be written here?\n");
  fs::remove(probe, failed);
}

void require_writable_file(const fs::path& file) {
  if (fs::is_directory(file))
    throw SystemError("cannot write " + file.string() + ": it is a folder");
  require_writable(fs::absolute(file).parent_path(), "choose another place for " + file.string());
}

std::string summary_json(const Trial& trial, const std::string& name) {
  Json summary;
  summary["scenario"] = name;
  summary["behaviour"] = trial.scenario.behaviour.kind();
  summary["seed"] = trial.scenario.trial.seed;
  summary["program"] = build_info().program;
  summary["vehicles"] = trial.world->size();
  summary["duration_s"] = trial.scenario.trial.duration_s;
  summary["mission_s"] = trial.world->time_s();
  summary["stopped_by"] = trial.world->stopped_by();
  summary["wall_s"] = trial.wall_s;
  summary["vehicle_seconds_per_wall_s"] = trial.vehicle_seconds_per_wall_s();
  Json& measures = summary["measures"] = Json::object();
  for (const auto& [measure, value] : trial.results.values) {
    measures[measure] = value ? Json(*value) : Json(nullptr);
  }
  return summary.dump(2) + "\n";
}

void write_trial(const Trial& trial, const std::string& name, const fs::path& folder) {
  require_writable(folder);
  // What stands there of an earlier trial would contradict this one, if this one is cut short.
  for (const char* earlier : run_files) {
    std::error_code ignored;
    // A device or a pipe keeps nothing, and is written to.
    if (!fs::is_other(folder / earlier, ignored)) fs::remove(folder / earlier, ignored);
  }
  write_text(folder / "scenario.toml", to_toml(scenarios::resolved_scenario(trial.scenario)));
  if (trial.record) {
    const scenarios::FileAttributes attributes{{"title", "shoal run of " + name},
                                               {"behaviour", trial.scenario.behaviour.kind()},
                                               {"seed", std::to_string(trial.scenario.trial.seed)},
                                               {"source", "shoal " SHOAL_VERSION}};
    trial.record->write(folder / "run.nc", *trial.world, attributes);
    scenarios::write_series(folder / "series.nc", in_cf_units(trial.results.series),
                            trial.scenario.trial.start, attributes);
  }
  write_text(folder / "summary.json", summary_json(trial, name));
}

}  // namespace shoal::analysis
