#pragma once

#include <optional>
#include <vector>

#include "shoal/analysis/statistics/sample.hpp"

namespace shoal::analysis::statistics {

/// Differences of two conditions under the same seeds, seed by seed, and how closely they are
/// known.
///
/// A difference of two doubles errs by their rounding, not by its own: 3/7 - 2/7 and 5/7 - 4/7 are
/// the same, and 0.3 - 0.1 - 0.2 is zero. Differences that are no further apart than `rounding`, 8
/// units of the greatest number that they are differences of, are ties to all tests.
class Differences {
 public:
  Differences() = default;
  /// Of numbers that are known to the rounding of the greatest of the differences themselves.
  /// Throws std::invalid_argument if one is not finite.
  Differences(std::vector<double> values);  // NOLINT(google-explicit-constructor)
  Differences(Sample values);               // NOLINT(google-explicit-constructor)

  /// ours[k] - theirs[k]. Throws std::invalid_argument unless there are as many of both, all
  /// finite.
  static Differences between(Sample ours, Sample theirs);

  const std::vector<double>& values() const { return values_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  double rounding() const { return rounding_; }
  bool is_zero(double difference) const;
  bool all_zero() const;

  /// Of their mean, as of any sample (sample.hpp); nothing also where the scatter is no more than
  /// rounding.
  std::optional<double> standard_error() const;

 private:
  std::vector<double> values_;
  double rounding_ = 0.0;
};

}  // namespace shoal::analysis::statistics
