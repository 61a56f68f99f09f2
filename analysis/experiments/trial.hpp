#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/trial_record.hpp"

namespace shoal::analysis {

/// A trial that was run: its measures, and the world as it was at the end.
struct Trial {
  scenarios::Scenario scenario;
  Results results;
  std::unique_ptr<scenarios::World> world;
  std::unique_ptr<scenarios::TrialRecord> record;  ///< null if nothing was recorded
  double wall_s = 0.0;                             ///< of the simulation, with its measures

  double vehicle_seconds_per_wall_s() const;
};

/// Of a trial, and trials of a sweep at a time.
inline constexpr int most_threads = 1024;

struct TrialSettings {
  int threads = 1;
  bool record = true;  ///< at trial.record_every_s, if that is above 0
  std::vector<scenarios::Observer*> observers = {};  ///< besides measures and record
  /// Sees what the planners of vehicles do, if given: of each vehicle, by its slot.
  std::function<formations::PlanObserver&(std::size_t vehicle)> plan_observer = {};
};

/// How often to look, in mission time, to notice within a second that a trial should end: some 5 s
/// of the mission, which take less also in a swarm of 100,000.
double watching_interval_s(const scenarios::Scenario& scenario);

/// Throws InputError if a trial of this world would keep more than a billion numbers: before it has
/// run for hours.
void require_holdable(const scenarios::World& world, bool record);

/// Runs a scenario. The measures are the same for any number of threads, with or without recording.
/// Throws InputError if the scenario cannot be run, or would keep more than a billion numbers.
Trial run_trial(const scenarios::Scenario& scenario, const TrialSettings& settings = {});

/// What stands in the folder of a run, its report included.
inline constexpr const char* run_files[] = {"scenario.toml", "summary.json", "run.nc", "series.nc",
                                            "report.html"};

/// The content of summary.json.
std::string summary_json(const Trial& trial, const std::string& name);

/// Writes scenario.toml (resolved), run.nc and series.nc (if recorded) and summary.json into a
/// folder, which is made if need be. Each file appears when it is complete, the summary last.
/// Throws SystemError.
void write_trial(const Trial& trial, const std::string& name, const std::filesystem::path& folder);

/// Throws SystemError unless files can be written in the folder (which is made if need be).
/// `remedy` ends the message.
void require_writable(const std::filesystem::path& folder,
                      const std::string& remedy = "choose another folder with --out");

/// The same for one file, before the long work that it is meant for.
void require_writable_file(const std::filesystem::path& file);

}  // namespace shoal::analysis
