#pragma once

#include <filesystem>
#include <vector>

#include "shoal/scenarios/series.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::scenarios {

/// Records the state of every vehicle at regular instants, for run.nc.
class TrialRecord final : public Observer {
 public:
  explicit TrialRecord(double every_s) : every_s_(every_s) {}

  double every_s() const override { return every_s_; }
  void observe(const World& world) override;
  /// How many numbers it keeps of each vehicle at each instant.
  static double numbers_of_each_vehicle();

  /// Writes trajectories as CF-1.8 describes them (sec. 9.3.1, orthogonal arrays: all vehicles
  /// share the time axis). The file appears under its name only when it is complete. Throws
  /// SystemError.
  void write(const std::filesystem::path& file, const World& world,
             const FileAttributes& attributes) const;

 private:
  double every_s_;
  std::vector<double> time_s_;
  std::vector<std::vector<float>> columns_;  // per variable: instants x vehicles
};

}  // namespace shoal::scenarios
