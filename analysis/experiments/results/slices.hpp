#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shoal/analysis/experiments/results/results.hpp"
#include "shoal/analysis/experiments/study/selection.hpp"
#include "shoal/analysis/statistics/differences.hpp"
#include "shoal/analysis/statistics/survival.hpp"

namespace shoal::analysis {

/// The column that tells the groups of a study apart, where a table shows several.
inline constexpr const char* group_column = "group";

bool contains(const std::vector<std::string>& names, const std::string& name);

/// Something by which the trials of a table differ: a factor, or the group.
struct Dimension {
  std::string name;
  std::string unit;
  std::vector<std::string> labels;  ///< in the order of the study
};

/// The answers of the trials in one place of a table.
struct Sample {
  std::vector<double> values;      ///< Answer::bounded()
  std::vector<std::string> pairs;  ///< of each value: what it shares with values of other places
  std::vector<bool> reached;       ///< of each value: whether its event came; true without one
  bool waits = false;              ///< the question is about an event that trials may never see
  bool times = false;              ///< ... and it asks when the event came
  int failed = 0;                  ///< trials that failed
  int not_run = 0;                 ///< trials that have not run yet

  std::vector<statistics::EventTime> event_times() const;
  /// How far the times of events are known (survival.hpp); infinite for what is no time.
  double horizon() const;
  /// The values; of times of events, restricted to a horizon, so that their mean is the restricted
  /// mean.
  std::vector<double> restricted(double horizon) const;
  /// Pair by pair; of times of events, restricted to the horizon that both have.
  statistics::Differences minus(const Sample& other) const;
  /// Trials that saw the event; nothing where there is none to see.
  std::optional<int> reached_count() const;
};

/// What a table is about.
struct Scope {
  std::vector<std::string> groups;  ///< none: all
  CellSelection where;
  std::vector<std::string> kept;    ///< the dimensions that the table shows
  std::vector<std::string> pooled;  ///< those whose levels are taken together
  bool keep_rest = false;           ///< dimensions that are neither are kept, too
  Origin origin;
};

/// The trials of a study parted by the dimensions of a table.
class Slices {
 public:
  /// Throws InputError for names that the study does not have, and for a factor with several levels
  /// that the table neither shows, selects nor pools: it would be averaged in silence.
  Slices(const StudyResults& results, const Scope& scope);

  /// Those kept: first as named, then the rest in the order of the study.
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  /// The places that have trials: the index of a label in each dimension; sorted.
  const std::vector<std::vector<std::size_t>>& places() const { return places_; }
  bool has(const std::vector<std::size_t>& place) const { return trials_.contains(place); }

  /// Empty where there are no trials.
  Sample sample(const std::vector<std::size_t>& place, const Question& question) const;

 private:
  struct Member {
    std::size_t trial;
    std::string pair;
  };

  const StudyResults& results_;
  std::vector<Dimension> dimensions_;
  std::vector<std::vector<std::size_t>> places_;
  std::map<std::vector<std::size_t>, std::vector<Member>> trials_;
};

/// The places of the groups named in the list; of all, for none. Throws InputError.
std::vector<std::size_t> places_of_groups(const std::vector<std::string>& names,
                                          const TrialList& list, const Origin& origin);

}  // namespace shoal::analysis
