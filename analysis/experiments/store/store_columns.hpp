#pragma once

#include <string>
#include <vector>

namespace shoal::analysis {

/// The columns of the table `trial` that come before those of factors and measures.
inline constexpr const char* columns_of_every_trial =
    "trial_key, trial_id, scenario_id, study_group, replication, seed, program, status, reason, "
    "wall_s";

/// The factors and measures that have a column in the table `trial`, by their names.
struct StoreColumns {
  std::vector<std::string> factors, measures;
};

// The columns of a factor and of a measure, as SQL wants them. No measure is called "f:...".
std::string factor_column(const std::string& factor);
std::string measure_column(const std::string& measure);

}  // namespace shoal::analysis
