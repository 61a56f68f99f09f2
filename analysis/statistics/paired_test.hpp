#pragma once

#include <memory>
#include <optional>
#include <string>

#include "shoal/analysis/statistics/paired_tests.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis::statistics {

/// A two-sided test of paired differences. Stateless and thread-safe.
class PairedTest {
 public:
  static constexpr const char* family = "paired_test";
  static constexpr const char* family_meaning = "tests paired differences, seed by seed";

  virtual ~PairedTest() = default;

  /// What stands before "test" in notes, and in the head of a column.
  virtual std::string title() const = 0;
  virtual std::string short_title() const { return title(); }
  /// How the names of columns end that hold its answers beside those of another test.
  virtual std::string column_ending() const { return "exact"; }

  /// Nothing where it has no answer.
  virtual std::optional<TestResult> test(const Differences& differences) const = 0;

  /// The least p-value that a test of `n` differences can give, whatever they are; 0 where there is
  /// no such bound.
  virtual double least_p_value(int n) const = 0;

  /// The chance that n normal differences are rejected at level `alpha`; see two_sided_power().
  virtual double power(int n, double effect, double alpha) const = 0;

  /// The test that tables print beside it, of other assumptions: Student's.
  virtual std::unique_ptr<PairedTest> beside() const;
};

/// Student's, and the sign-flip test, where there is no choice.
std::unique_ptr<PairedTest> student_test();
std::unique_ptr<PairedTest> randomisation_test();

}  // namespace shoal::analysis::statistics
