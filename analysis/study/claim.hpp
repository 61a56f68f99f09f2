#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/study/results.hpp"
#include "shoal/analysis/study/selection.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

/// One comparison that a claim comes down to: a number per replication, and the numbers for which
/// the claim holds.
struct Contrast {
  std::string title;             ///< which cells
  std::vector<double> numbers;   ///< of the replications that have one
  std::optional<double> low, high;  ///< the claim holds for a mean between them (one may be absent)
};

/// The cells that a claim is about: those of one group in which only the factors it compares differ.
struct ClaimScope {
  const StudyResults& results;
  const Question& question;
  std::size_t group = 0;
  std::vector<std::size_t> cells;
  std::string title;  ///< of the factors that are the same in all these cells; "" for none

  /// The only cell of the scope that a selection holds. Throws InputError if there is none, or more.
  std::size_t cell(const CellSelection& selection) const;
  /// Of each replication, the answer, or nothing.
  std::vector<std::optional<double>> answers(std::size_t cell) const;
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

  Question question() const { return {metric, series, "", at_s}; }
};

enum class Verdict { reproduced, contradicted, undecided };
std::string_view name_of(Verdict verdict);

/// What the trials say to one contrast.
struct ContrastResult {
  std::string title;
  int n = 0;
  std::optional<double> mean, low, high;  ///< with Student's 95 % interval
  Verdict verdict = Verdict::undecided;
};

struct ClaimResult {
  Verdict verdict = Verdict::undecided;
  std::vector<ContrastResult> contrasts;
  /// Where undecided: replications that would decide it with a chance of 80 %, if means and scatter
  /// are as they seem; nothing if 10,000 would not.
  std::optional<int> replications_needed;
};

/// Tests a claim. It is reproduced if every contrast is (each interval lies where the claim holds),
/// and contradicted if the interval of any lies where it does not, at a level corrected for their
/// number (Bonferroni). Throws InputError if the claim names what the study does not have.
ClaimResult test_claim(const Claim& claim, const StudyResults& results);

/// Reads `[[claim]]`s. Throws InputError.
std::vector<Claim> read_claims(const Setting& root);

}  // namespace shoal::analysis
