#pragma once

#include <filesystem>
#include <string>

#include "shoal/analysis/study/plan.hpp"
#include "shoal/analysis/study/sweep.hpp"

namespace shoal::analysis {

/// Writes study.toml (with every file it names made absolute, or copied beside it) and claims.toml.
void write_study(const StudyPlan& plan, const std::filesystem::path& folder);

/// manifest.json: the study, its seeds, the program, and every sweep that worked on the folder,
/// each with its host and times.
class Manifest {
 public:
  Manifest(const StudyPlan& plan, const std::filesystem::path& folder,
           const SweepSettings& settings);

  void begin();
  void end(const SweepProgress& progress);

 private:
  void write(const std::string& finished, const SweepProgress& progress) const;

  const StudyPlan& plan_;
  std::filesystem::path folder_;
  SweepSettings settings_;
  std::string earlier_;  // what other sweeps left, as JSON
  std::string began_;
};

}  // namespace shoal::analysis
