#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/results/contrast.hpp"
#include "shoal/core/registry.hpp"

namespace shoal::analysis {

struct ClaimScope;

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

/// A number of every trial, and what is said of it over trials.
struct TestedStatement {
  std::string says;  ///< in our words
  std::vector<std::string> groups;
  Setting where;
  std::string measure;
  std::string series;  ///< instead of a measure, with `at_s`
  double at_s = 0.0;
  double since_s = std::numeric_limits<double>::infinity();  ///< infinite: not of a change
  std::string minus;  ///< the number is less this one of the same trial; "" for none
  Average average = Average::mean;
  Choice<ClaimTest> test{"lower"};
  Origin origin;

  bool of_a_change() const { return since_s < std::numeric_limits<double>::infinity(); }
  std::string unit() const;
  /// Makes its test once. Throws InputError for what no measure yields and for options of the test
  /// that are wrong.
  void require_known() const;
  std::optional<std::string> complaint() const;
};

/// What may be behind a contradiction: a statement that is tested itself.
struct Cause : TestedStatement {
  std::string study;  ///< whose stored trials show it; "" for those of the claim

  static constexpr const char* noun = "a cause";
  static void declare(Options<Cause>& o);
};

/// A statement on the trials of a study, and the test it becomes.
struct Claim : TestedStatement {
  std::int64_t statement = 0;  ///< the statement that it is a part of; 0: it stands alone
  std::string section;         ///< where it is stated
  Setting written_cause;
  std::optional<Cause> cause;

  static constexpr const char* noun = "a claim";
  static void declare(Options<Claim>& o);
};

/// The words of a statement with several parts, or of one that is not tested.
struct StatementWords {
  std::int64_t number = 0;
  std::string section;
  std::string says;
  std::string not_tested;  ///< why, of a statement without a claim
  Origin origin;

  static constexpr const char* noun = "a statement";
  static void declare(Options<StatementWords>& o);
  std::optional<std::string> complaint() const;
};

enum class Correction { none, holm };

/// What a file of claims says.
struct ClaimFile {
  Correction correction = Correction::holm;
  std::string side_by_side;  ///< the factor whose levels get verdicts of their own; "" for none
  std::vector<StatementWords> statements;
  std::vector<Claim> claims;

  bool empty() const { return statements.empty() && claims.empty(); }

  static constexpr const char* noun = "a file of claims";
  static void declare(Options<ClaimFile>& o);
};

/// Reads and checks all that can be checked without the study. Throws InputError.
ClaimFile read_claims(const Setting& root);

/// All claims, and those of their causes that the trials of the same study show.
std::vector<const TestedStatement*> tested_on_the_study(const ClaimFile& file);

}  // namespace shoal::analysis
