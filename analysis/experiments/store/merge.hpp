#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

/// What a merge found in one folder.
struct MergedFolder {
  std::filesystem::path folder;
  std::size_t trials = 0;  ///< of the study, stored there
  std::size_t taken = 0;   ///< of them, that no folder before it had
  std::size_t others = 0;  ///< of an earlier form of the study: they stay where they are
};

struct Merged {
  TrialList list;
  std::vector<MergedFolder> folders;   ///< the one that was merged into comes first
  std::size_t stored = 0, failed = 0;  ///< of the trials that the study asks for
};

/// Makes `folder` hold every trial that it and `others` hold of one study, and tell of every sweep
/// that ran them. It may be new, and may stand among the others. The others stay as they are.
///
/// A trial stored in several folders is taken once if they agree on it (how long it took aside).
/// Throws InputError if the folders hold different studies, if one trial came out differently in
/// two of them, or if its seed, cell or program was another in one of them; SystemError if a folder
/// is in use or cannot be written. Trials are stored in one transaction: after an error, or if the
/// merge is killed, the folder holds those that it had.
Merged merge(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& others);

}  // namespace shoal::analysis
