#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "shoal/analysis/reporting/recorded_run.hpp"
#include "shoal/formations/plan.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::analysis {

/// The recorded instants that a page shows: all, or one in `every` and the last, so that the page
/// stays small.
struct ShownInstants {
  std::vector<std::size_t> of_record;
  std::size_t every = 1;

  explicit ShownInstants(const RecordedRun& run);
};

/// Places, headings and numbers of every vehicle at these instants.
nlohmann::ordered_json packed_tracks(const RecordedRun& run, const ShownInstants& shown);

/// Which slot of the plan each vehicle takes, as the formation quality assigns them, at some of
/// these instants, the last among them; a lost vehicle has none.
nlohmann::ordered_json packed_matches(const RecordedRun& run, const ShownInstants& shown,
                                      const formations::Plan& plan,
                                      const scenarios::QualityOptions& quality);

}  // namespace shoal::analysis
