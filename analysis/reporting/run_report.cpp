#include "shoal/analysis/reporting/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/reporting/current_arrows.hpp"
#include "shoal/analysis/reporting/packed.hpp"
#include "shoal/analysis/reporting/page.hpp"
#include "shoal/analysis/reporting/recorded_run.hpp"
#include "shoal/analysis/reporting/run_tracks.hpp"
#include "shoal/core/text.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/formations/obstacles/outline.hpp"
#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Notes = std::vector<std::string>;

std::string content(const fs::path& file) {
  std::optional<std::string> text = read_whole_file(file);
  if (!text)
    throw InputError("there is no " + file.string() + "; name a folder that shoal run wrote");
  return *std::move(text);
}

Json read_summary(const fs::path& file) {
  Json summary = Json::parse(content(file), nullptr, false);
  if (summary.is_object() && summary.contains("metrics")) {
    throw InputError(file.string() + ": metrics is now measures; write that, or run it again");
  }
  if (!summary.is_object() || !summary.contains("measures")) {
    throw InputError(file.string() + " is none that shoal run wrote, or is damaged");
  }
  return summary;
}

/// Every measure with what it means, in the order of the summary.
Json measures(const Json& summary) {
  Json rows = Json::array();
  for (const auto& [name, value] : summary["measures"].items()) {
    const auto& known = known_values();
    const auto found = std::ranges::find(known, name, &Quantity::name);
    rows.push_back({{"name", name},
                    {"value", value},
                    {"unit", found == known.end() ? "" : found->unit},
                    {"meaning", found == known.end() ? "" : found->meaning}});
  }
  return rows;
}

Json packed_series(const std::vector<scenarios::Series>& all) {
  Json packed = Json::array();
  for (const scenarios::Series& series : all) {
    const auto& known = known_series();
    const auto found = std::ranges::find(known, series.name, &Quantity::name);
    packed.push_back({{"name", series.name},
                      {"unit", found == known.end() ? series.unit : found->unit},
                      {"meaning", series.meaning},
                      {"time_s", packed_floats(series.time_s)},
                      {"values", packed_floats(series.values)}});
  }
  return packed;
}

Json point(const Eigen::Vector2d& place) {
  return {place.x(), place.y()};
}

Region region_of(const RecordedRun& run) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Region region{infinity, -infinity, infinity, -infinity};
  for (const double x : run.column("x")) {
    if (!std::isfinite(x)) continue;
    region.west = std::min(region.west, x);
    region.east = std::max(region.east, x);
  }
  for (const double y : run.column("y")) {
    if (!std::isfinite(y)) continue;
    region.south = std::min(region.south, y);
    region.north = std::max(region.north, y);
  }
  return region;
}

/// What moves, and what it moves through.
void add_playback(const scenarios::Scenario& scenario, const RecordedRun& run, Json& data,
                  Notes& notes) {
  const ShownInstants shown(run);
  if (shown.every > 1) {
    notes.push_back("The playback shows one in " + std::to_string(shown.every) +
                    " recorded instants, to keep this page small; run.nc holds all.");
  }
  std::vector<double> times;
  for (const std::size_t k : shown.of_record) times.push_back(run.time_s[k]);
  const formations::Plan plan = scenario.plan.make()->plan();
  if (static_cast<std::size_t>(plan.size()) != run.vehicles) {
    throw InputError("run.nc has " + std::to_string(run.vehicles) + " vehicles, scenario.toml " +
                     std::to_string(plan.size()) + "; they are of different runs");
  }
  data["vehicles"] = plan.names();
  data["end_s"] = times.back();  // a trial may end early
  data["time_s"] = packed_floats(times);
  data["tracks"] = packed_tracks(run, shown);
  data["matches"] = packed_matches(run, shown, plan, scenario.quality);
  for (int r = 0; r < formations::reason_count; ++r) {
    data["reasons"].push_back(name_of(static_cast<formations::Reason>(r)));
  }
  for (const Eigen::Vector2d& slot : plan.slots()) data["plan"].push_back(point(slot));

  data["obstacles"] = Json::array();
  for (const auto& obstacle : scenarios::make_obstacles(scenario.obstacles)) {
    Json& edge = data["obstacles"].emplace_back(Json::array());
    for (const Eigen::Vector2d& corner : formations::outline(*obstacle))
      edge.push_back(point(corner));
  }
  data["waypoint"] = scenario.waypoint ? point(scenario.waypoint->place()) : Json(nullptr);
  data["arrival_radius_m"] = scenario.waypoint ? Json(scenario.waypoint->radius_m) : Json(nullptr);
  const auto drifting_radius_m = scenario.guidance.make()->drifting_radius_m();
  data["drifting_radius_m"] = drifting_radius_m ? Json(*drifting_radius_m) : Json(nullptr);
  data["range_m"] = scenario.ping.range_m;
  try {
    data["current"] = current_arrows(*scenario.current.make(), region_of(run), times.back());
  } catch (const InputError& error) {
    data["current"] = nullptr;
    notes.push_back("The current is not shown: " + std::string(error.what()) + ".");
  }
}

}  // namespace

std::vector<std::string> write_run_report(const fs::path& folder) {
  const Json summary = read_summary(folder / "summary.json");
  const fs::path scenario_file = folder / "scenario.toml";
  const scenarios::Scenario scenario =
      scenarios::read_scenario(scenarios::read_toml(scenario_file));
  Notes notes;
  Json data;
  for (const char* same : {"behaviour", "seed", "duration_s", "program"}) {
    data[same] = summary.value(same, Json(nullptr));
  }
  data["end_s"] = data["duration_s"];
  data["title"] = summary.value("scenario", "");
  data["measures"] = measures(summary);
  data["scenario"] = content(scenario_file);
  data["vehicles"] = Json::array();
  data["series"] = Json::array();
  if (fs::exists(folder / "run.nc")) {
    const RecordedRun run = read_recorded_run(folder);
    if (run.time_s.empty()) throw InputError((folder / "run.nc").string() + " holds no instant");
    add_playback(scenario, run, data, notes);
    data["series"] = packed_series(run.series);
  } else {
    notes.push_back(
        "There is no playback: nothing was recorded (trial.record_every_s is 0, or run.nc is "
        "gone).");
  }
  data["notes"] = notes;
  write_whole_file(folder / "report.html", whole_page("run.html", data));
  return notes;
}

}  // namespace shoal::analysis
