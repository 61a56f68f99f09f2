#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "shoal/scenarios/world.hpp"

namespace shoal::scenarios {

/// One number of the whole swarm against time, with its own instants.
struct Series {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<double> time_s;
  std::vector<double> values;
};

/// Records the state of every vehicle at regular instants, for run.nc.
class TrialRecord final : public Observer {
 public:
  explicit TrialRecord(double every_s) : every_s_(every_s) {}

  double every_s() const override { return every_s_; }
  void observe(const World& world) override;

  /// Writes a CF-1.8 file (trajectories; dimensions vehicle and time) that xarray opens. The file
  /// appears under its name only when it is complete. Throws SystemError.
  void write(const std::filesystem::path& file, const World& world,
             const std::vector<Series>& series,
             const std::vector<std::pair<std::string, std::string>>& attributes) const;

 private:
  double every_s_;
  std::vector<double> time_s_;
  std::vector<std::vector<float>> columns_;  // per variable: instants x vehicles
};

}  // namespace shoal::scenarios
