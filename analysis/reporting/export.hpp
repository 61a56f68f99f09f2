#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/results/results.hpp"

namespace shoal::analysis {

/// Everything that is stored of a study, for other programs.
class StudyExport {
 public:
  /// Throws InputError if the folder holds no trials, or if they were run by different programs.
  explicit StudyExport(const std::filesystem::path& folder);

  const StudyResults& results() const { return results_; }

  /// One row a trial, in the order of the list, those that have not run among them: group, factors,
  /// replication (from 1), seed, status (`done`, `failed`, `missing`), reason, and every measure.
  /// Names end with their units. A factor that a group lacks, or that does not apply, and a measure
  /// without a value are empty. Throws InputError if two things would head one column.
  std::string csv() const;

  /// A netCDF-4 file of CF-1.8 attributes with a netCDF group for each named group of the study.
  ///
  /// Measures are variables (factors ..., replication); a design that draws its cells has the
  /// dimension `cell`, with the factors as coordinates along it. Series are variables
  /// NAME_over_time (factors ..., replication, time). NaN stands for what has no value; the
  /// variable `status` says why. A level at which a factor does not apply is NaN, or `-` among
  /// texts. Throws SystemError.
  void write_netcdf(const std::filesystem::path& file) const;

 private:
  StudyExport(const TrialList& list, const Store& store);

  std::vector<std::string> measures_, series_;
  StudyResults results_;
};

}  // namespace shoal::analysis
