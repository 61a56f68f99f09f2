#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"
#include "shoal/analysis/tables/table.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// A group of trials whose answers are analysed, and what its tables have in common.
class AnalysedGroup {
 public:
  AnalysedGroup(const SensitivityRequest& request, const StudyResults& results, std::size_t group)
      : request_(request), results_(results), group_(group) {}

  const SensitivityRequest& request() const { return request_; }
  const TrialGroup& planned() const { return results_.list().groups()[group_]; }
  static Resampling resampling();

  /// The first cells of a row: the measure and the factor.
  std::vector<Cell> row(const std::string& measure, std::size_t factor) const;
  /// Of each replication, cell by cell in the order of the design.
  AnswersBySeed answers(const std::string& measure) const;

 private:
  const SensitivityRequest& request_;
  const StudyResults& results_;
  std::size_t group_;
};

/// An index with its interval.
Cell cell_of(const IndexEstimate& estimate);

/// What a note says of the samples behind the indices of a measure.
std::string note_on_samples(const std::string& measure, int count, int left_out,
                            const std::string& samples, const std::string& undefined);

/// What the answers to a design say of its factors. It is called as the design that it analyses:
/// what such a design needs is known where its cells are.
class SensitivityAnalysis {
 public:
  static constexpr const char* family = "sensitivity_table";
  static constexpr const char* family_meaning =
      "tables of what the answers to the design of that name say of its factors";

  virtual ~SensitivityAnalysis() = default;
  virtual std::vector<Table> tables(const AnalysedGroup& group) const = 0;
};

}  // namespace shoal::analysis
