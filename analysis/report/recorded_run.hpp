#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "shoal/scenarios/trial_record.hpp"

namespace shoal::analysis {

/// What run.nc holds.
struct RecordedRun {
  std::vector<double> time_s;
  std::size_t vehicles = 0;
  /// Recorded numbers by name: a vehicle after the other, each at all instants.
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  std::vector<scenarios::Series> series;  ///< with the units of the file

  /// Throws InputError if it was not recorded.
  const std::vector<double>& column(const std::string& name) const;
};

/// Throws InputError, beginning with the name of the file, if it cannot be read, or is none that
/// `shoal run` wrote.
RecordedRun read_recorded_run(const std::filesystem::path& file);

}  // namespace shoal::analysis
