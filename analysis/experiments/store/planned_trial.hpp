#pragma once

#include <optional>
#include <string>

#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

/// A trial as the study plans it: key, group, factors, replication and seed, and no outcome.
StoredTrial planned_trial(const TrialList& list, const ListedTrial& planned);

/// What a stored trial of the key of `planned` says otherwise than the study, such as `seed is 5,
/// and 3 in the study`; nothing if they agree.
std::optional<std::string> contradiction(const TrialList& list, const ListedTrial& planned,
                                         const StoredTrial& stored);

}  // namespace shoal::analysis
