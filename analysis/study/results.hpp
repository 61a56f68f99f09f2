#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/study/plan.hpp"
#include "shoal/analysis/study/store.hpp"

namespace shoal::analysis {

/// A number that tables and claims ask of every trial: a metric, or a series at some place.
struct Question {
  std::string metric;   ///< or "" for a series
  std::string series;   ///< its name
  std::string against;  ///< the series that `at` is a value of; "" for time
  double at = 0.0;      ///< s, or the unit of `against`
};

/// What is stored of the trials that a study asks for, by their places in the plan.
class StudyResults {
 public:
  enum class State : std::uint8_t { missing, failed, done };

  /// Of a study whose trials all are missing; these metrics and series may be asked for.
  StudyResults(const StudyPlan& plan, const std::vector<std::string>& metrics,
               const std::vector<std::string>& series);

  /// Reads these metrics and these series. Throws InputError if trials of the study were run by
  /// different programs.
  StudyResults(const StudyPlan& plan, const Store& store, const std::vector<std::string>& metrics,
               const std::vector<std::string>& series);

  const StudyPlan& plan() const { return plan_; }
  State state(std::size_t trial) const { return states_[trial]; }
  std::size_t count(State state) const;
  const std::string& failure(std::size_t trial) const { return failures_[trial]; }
  /// The shoal that ran the trials; "" if none has run.
  const std::string& program() const { return program_; }

  /// Nothing if the trial is missing or failed, or if what is asked for has no value there: a
  /// metric that is null, a series that begins later or ends before.
  std::optional<double> answer(const Question& question, std::size_t trial) const;

  const scenarios::Series* series(const std::string& name, std::size_t trial) const;

 private:
  StudyPlan plan_;
  std::vector<State> states_;
  std::vector<std::string> failures_;
  std::string program_;
  std::map<std::string, std::vector<std::optional<double>>> metrics_;
  std::map<std::string, std::vector<std::optional<scenarios::Series>>> series_;
};

/// The value of a series at a time, linear between its instants; nothing outside them.
std::optional<double> value_at(const scenarios::Series& series, double time_s);

/// When a series that does not fall first reaches a value, linear between its instants; nothing if
/// it never does, or began above.
std::optional<double> time_of(const scenarios::Series& series, double value);

}  // namespace shoal::analysis
