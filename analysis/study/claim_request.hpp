#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shoal/core/registry.hpp"

namespace shoal::analysis {

struct ClaimScope;

/// One comparison that a claim comes down to: a number per replication, and the numbers for which
/// the claim holds.
struct Contrast {
  std::string title;                ///< which cells
  std::vector<double> numbers;      ///< of the replications that have one
  std::optional<double> low, high;  ///< the claim holds for a mean between them (one may be absent)
  bool of_each = false;             ///< the claim is on each number instead, ends included
  int missing = 0;                  ///< replications without a number, if it is
};

/// How a statement becomes a test.
class ClaimTest {
 public:
  static constexpr const char* family = "claim_test";
  static constexpr const char* family_meaning = "turns a statement on trials into contrasts";

  virtual ~ClaimTest() = default;
  /// Names of the factors whose levels it compares; all others are the same within a scope.
  virtual std::vector<std::string> compared() const = 0;
  virtual std::vector<Contrast> contrasts(const ClaimScope& scope) const = 0;
};

/// A statement on the trials of a study, and the test it becomes.
struct Claim {
  std::string section;  ///< where it is stated
  std::string says;     ///< in our words
  std::vector<std::string> groups;
  Setting where;
  std::string metric;
  std::string series;  ///< instead of a metric, with `at_s`
  double at_s = 0.0;
  std::string cause;  ///< the likely one, printed only if the trials contradict the claim
  Choice<ClaimTest> test{"lower"};
  Origin origin;

  static constexpr const char* noun = "a claim";
  static void declare(Options<Claim>& o);
  std::optional<std::string> complaint() const;
};

/// Reads `[[claim]]`s. Throws InputError.
std::vector<Claim> read_claims(const Setting& root);

}  // namespace shoal::analysis
