#include "shoal/analysis/reporting/run_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "shoal/analysis/experiments/measures/formation_quality.hpp"
#include "shoal/analysis/reporting/packed.hpp"

namespace shoal::analysis {
namespace {

using Json = nlohmann::ordered_json;

// 20 vehicles for five hours at every 5 s, with room: about 2.3 MB of text.
constexpr std::size_t most_samples = 80'000;
constexpr std::size_t most_matches = 200;
// Matching takes about the third power of the number of vehicles: no more than a second of it.
constexpr double most_match_work = 2e7;

std::vector<double> at(const RecordedRun& run, const ShownInstants& shown,
                       const std::vector<double>& column) {
  std::vector<double> picked;
  picked.reserve(run.vehicles * shown.of_record.size());
  for (std::size_t i = 0; i < run.vehicles; ++i) {
    for (const std::size_t k : shown.of_record) picked.push_back(column[i * run.time_s.size() + k]);
  }
  return picked;
}

/// Bit 0: thrusting; above: why the target is what it is.
std::string packed_modes(const RecordedRun& run, const ShownInstants& shown) {
  const std::vector<double> thrusting = at(run, shown, run.column("thrusting"));
  const std::vector<double> reason = at(run, shown, run.column("target_reason"));
  std::vector<std::uint8_t> modes;
  for (std::size_t k = 0; k < thrusting.size(); ++k) {
    const bool lost = std::isnan(thrusting[k]) || std::isnan(reason[k]);
    modes.push_back(
        lost ? 0 : static_cast<std::uint8_t>(2 * static_cast<int>(reason[k]) + (thrusting[k] > 0)));
  }
  return packed_bytes(modes);
}

std::vector<double> energy_wh(const RecordedRun& run) {
  std::vector<double> sum = run.column("energy_propulsion");
  for (const char* part : {"energy_hotel", "energy_comms"}) {
    const std::vector<double>& column = run.column(part);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += column[k];
  }
  return sum;
}

std::vector<std::size_t> matched_instants(const ShownInstants& shown, std::size_t vehicles) {
  const double one = std::pow(static_cast<double>(vehicles), 3.0);
  const auto count =
      std::clamp(static_cast<std::size_t>(most_match_work / one), std::size_t{1}, most_matches);
  const std::size_t every = (shown.of_record.size() + count - 1) / count;
  std::vector<std::size_t> instants;
  for (std::size_t s = 0; s < shown.of_record.size(); s += every) {
    instants.push_back(shown.of_record[s]);
  }
  if (instants.back() != shown.of_record.back()) instants.push_back(shown.of_record.back());
  return instants;
}

/// Of each vehicle at one instant.
std::vector<std::uint16_t> slots_at(const RecordedRun& run, std::size_t instant,
                                    FormationQuality& quality) {
  const std::vector<double>& x = run.column("x");
  const std::vector<double>& y = run.column("y");
  std::vector<Eigen::Vector2d> places;
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < run.vehicles; ++i) {
    const std::size_t at = i * run.time_s.size() + instant;
    const Eigen::Vector2d place(x[at], y[at]);
    if (!place.allFinite()) continue;
    places.push_back(place);
    left.push_back(i);
  }
  std::vector<std::uint16_t> slots(run.vehicles, std::numeric_limits<std::uint16_t>::max());
  if (places.empty()) return slots;
  quality.of(places);
  for (std::size_t p = 0; p < left.size(); ++p) {
    slots[left[p]] = static_cast<std::uint16_t>(quality.slot_of_position()[p]);
  }
  return slots;
}

}  // namespace

ShownInstants::ShownInstants(const RecordedRun& run) {
  const std::size_t instants = run.time_s.size();
  every = std::max<std::size_t>(1, (instants * run.vehicles + most_samples - 1) / most_samples);
  for (std::size_t k = 0; k < instants; k += every) of_record.push_back(k);
  if (instants > 0 && of_record.back() != instants - 1) of_record.push_back(instants - 1);
}

Json packed_tracks(const RecordedRun& run, const ShownInstants& shown) {
  Json levels;
  for (const char* name : {"heading", "speed", "target_x", "target_y", "distance", "thrust_time"}) {
    levels[name] = packed_levels(at(run, shown, run.column(name)));
  }
  levels["energy"] = packed_levels(at(run, shown, energy_wh(run)));
  return {{"x", packed_steps(at(run, shown, run.column("x")), run.vehicles)},
          {"y", packed_steps(at(run, shown, run.column("y")), run.vehicles)},
          {"mode", packed_modes(run, shown)},
          {"levels", levels}};
}

Json packed_matches(const RecordedRun& run, const ShownInstants& shown,
                    const formations::Plan& plan, const scenarios::QualityOptions& options) {
  FormationQuality quality(plan, options);
  std::vector<double> times;
  std::vector<std::uint16_t> slots;
  for (const std::size_t instant : matched_instants(shown, run.vehicles)) {
    const std::vector<std::uint16_t> row = slots_at(run, instant, quality);
    times.push_back(run.time_s[instant]);
    slots.insert(slots.end(), row.begin(), row.end());
  }
  return {{"time_s", packed_floats(times)}, {"slots", packed_indices(slots)}};
}

}  // namespace shoal::analysis
