#pragma once

#include <string>
#include <vector>

#include "shoal/analysis/tables/table.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// What stands in a cell of a table, of the values that its replications gave. Stateless.
class Statistic {
 public:
  static constexpr const char* family = "statistic";
  static constexpr const char* family_meaning =
      "what stands in a cell of a table, over replications";

  virtual ~Statistic() = default;

  /// What a note says of it: `Means.`
  virtual std::string note() const = 0;

  /// Of values, of which there is at least one.
  virtual Estimate of(const std::vector<double>& values) const = 0;

  /// Whether it says what the values are, rather than how many there are.
  virtual bool is_of_values() const { return true; }
};

/// The mean of values, of which there is at least one, with the digits that it deserves.
Estimate mean_of(const std::vector<double>& values);

/// The same, with half the width of Student's 95 % confidence interval, if it has one.
Estimate mean_with_interval(const std::vector<double>& values);

}  // namespace shoal::analysis
