#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "shoal/analysis/trial.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

// Under a hidden name until it is complete, so that nothing half-written carries the final one.
void write_text(const fs::path& file, const std::string& text) {
  const fs::path partial = file.parent_path() / ("." + file.filename().string() + ".partial");
  std::ofstream out(partial, std::ios::binary);
  out << text;
  out.close();
  std::error_code failed;
  if (out) fs::rename(partial, file, failed);
  if (!out || failed) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw SystemError("cannot write " + file.string() + "; check free space and permissions");
  }
}

}  // namespace

void require_writable(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed && !fs::is_directory(folder)) failed = std::make_error_code(std::errc::not_a_directory);
  if (!failed && ::access(folder.c_str(), W_OK | X_OK) != 0) {
    failed = std::error_code(errno, std::generic_category());
  }
  if (failed) {
    throw SystemError("cannot write into " + folder.string() + ": " + failed.message() +
                      "; choose another folder with --out");
  }
}

std::string summary_json(const Trial& trial, const std::string& name) {
  using Json = nlohmann::ordered_json;
  Json summary;
  summary["scenario"] = name;
  summary["behaviour"] = trial.scenario.behaviour.kind();
  summary["seed"] = trial.scenario.trial.seed;
  summary["vehicles"] = trial.world->size();
  summary["duration_s"] = trial.scenario.trial.duration_s;
  summary["wall_s"] = trial.wall_s;
  summary["vehicle_seconds_per_wall_s"] = trial.vehicle_seconds_per_wall_s();
  Json& metrics = summary["metrics"] = Json::object();
  for (const auto& [metric, value] : trial.results.values) {
    metrics[metric] = value ? Json(*value) : Json(nullptr);
  }
  return summary.dump(2) + "\n";
}

void write_trial(const Trial& trial, const std::string& name, const fs::path& folder) {
  require_writable(folder);
  write_text(folder / "scenario.toml", to_toml(scenarios::resolved_scenario(trial.scenario)));
  if (trial.record) {
    trial.record->write(folder / "run.nc", *trial.world, trial.results.series,
                        {{"title", "shoal run of " + name},
                         {"behaviour", trial.scenario.behaviour.kind()},
                         {"seed", std::to_string(trial.scenario.trial.seed)},
                         {"source", "shoal " SHOAL_VERSION}});
  } else {
    std::error_code ignored;
    fs::remove(folder / "run.nc", ignored);  // of an earlier run: it would contradict the summary
  }
  write_text(folder / "summary.json", summary_json(trial, name));
}

}  // namespace shoal::analysis
