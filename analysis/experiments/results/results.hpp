#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/store/store.hpp"
#include "shoal/analysis/experiments/study/trial_list.hpp"

namespace shoal::analysis {

/// A number that tables and claims ask of every trial: a measure, or a series at some place.
struct Question {
  std::string measure;  ///< or "" for a series
  std::string series;   ///< its name
  std::string against;  ///< the series that `at` is a value of; "" for time
  double at = 0.0;      ///< s, or the unit of `against`
};

/// What a trial answers.
struct Answer {
  enum class Kind : std::uint8_t {
    not_run,
    failed,
    undefined,      ///< the question makes no sense of this trial: nothing was measured
    never_reached,  ///< the event asked about did not come while the trial was watched
    value,
  };
  Kind kind = Kind::not_run;
  /// Of an event that never came: how long the trial was watched for it, or what was measured then.
  double number = 0.0;

  bool has_number() const { return kind == Kind::never_reached || kind == Kind::value; }
  /// The number, with the end of the watch for an event that never came; or nothing.
  std::optional<double> bounded() const {
    return has_number() ? std::optional(number) : std::nullopt;
  }
};

/// What is stored of the trials that a study asks for, by their places in the list.
class StudyResults {
 public:
  enum class State : std::uint8_t { missing, failed, done };

  /// Of a study whose trials all are missing; these measures (and those that say whether their
  /// events came) and series may be asked for.
  StudyResults(const TrialList& list, const std::vector<std::string>& measures,
               const std::vector<std::string>& series);

  /// Reads these measures and these series. Throws InputError if trials of the study were run by
  /// different programs, or if a seed or a label is not the study's.
  StudyResults(const TrialList& list, const Store& store, const std::vector<std::string>& measures,
               const std::vector<std::string>& series);

  const TrialList& list() const { return list_; }
  State state(std::size_t trial) const { return states_[trial]; }
  std::size_t count(State state) const;
  const std::string& failure(std::size_t trial) const { return failures_[trial]; }
  /// The shoal that ran the trials; "" if none has run.
  const std::string& program() const { return program_; }

  /// Undefined is a measure that is null, a series that begins later or ends before.
  Answer answer(const Question& question, std::size_t trial) const;

  /// A measure as the trial stored it: nothing where it is null, or the trial is not done.
  std::optional<double> stored(const std::string& measure, std::size_t trial) const;

  const scenarios::Series* series(const std::string& name, std::size_t trial) const;

 private:
  TrialList list_;
  std::vector<State> states_;
  std::vector<std::string> failures_;
  std::string program_;
  std::map<std::string, std::vector<std::optional<double>>> measures_;
  std::map<std::string, Quantity> events_;  ///< those of the measures that wait for an event
  std::map<std::string, std::vector<std::optional<scenarios::Series>>> series_;
};

/// The value of a series at a time, linear between its instants; nothing outside them.
std::optional<double> value_at(const scenarios::Series& series, double time_s);

/// When a series that does not fall first reaches a value, linear between its instants; nothing if
/// it never does, or began above.
std::optional<double> time_of(const scenarios::Series& series, double value);

}  // namespace shoal::analysis
