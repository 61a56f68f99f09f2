#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "shoal/scenarios/series.hpp"

namespace shoal::analysis {

/// What run.nc and series.nc hold.
struct RecordedRun {
  std::vector<double> time_s;
  std::size_t vehicles = 0;
  /// Recorded numbers by name: a vehicle after the other, each at all instants.
  std::vector<std::pair<std::string, std::vector<double>>> columns;
  std::vector<scenarios::Series> series;  ///< with the units of the file

  /// Throws InputError if it was not recorded.
  const std::vector<double>& column(const std::string& name) const;
};

/// Of the folder of a run. Throws InputError, beginning with the name of the file, if one of them
/// cannot be read, or is none that `shoal run` wrote.
RecordedRun read_recorded_run(const std::filesystem::path& folder);

}  // namespace shoal::analysis
