#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace shoal::scenarios {

/// One number of the whole swarm against time, with its own instants.
struct Series {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<double> time_s;  ///< since mission start
  std::vector<double> values;
};

/// Global attributes of a file, by name.
using FileAttributes = std::vector<std::pair<std::string, std::string>>;

/// Writes a CF-1.8 file in which every series has a time axis of its own; a series without instants
/// is left out. `start` is the UTC of mission start. The file appears under its name only when it
/// is complete. Throws SystemError.
void write_series(const std::filesystem::path& file, const std::vector<Series>& series,
                  const std::string& start, const FileAttributes& attributes);

}  // namespace shoal::scenarios
