#include "shoal/analysis/experiments/study/trial_list.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

// What else is said of trials, in stores, tables and exported files.
constexpr std::array<std::string_view, 14> reserved{
    "study_group", "replication", "seed",    "status", "reason",      "trial_id", "scenario_id",
    "program",     "wall_s",      "measure", "time_s", sample_column, "time",     "cell"};

/// Whether every trial has a column of that name, which a factor would hide.
bool is_taken(const std::string& name) {
  const auto has = [&](const std::vector<Quantity>& quantities) {
    return std::ranges::find(quantities, name, &Quantity::name) != quantities.end();
  };
  return std::ranges::find(reserved, name) != reserved.end() || has(known_values()) ||
         has(known_series());
}

constexpr double most_trials = 1e6;  // some seconds and 0.1 GB to list

/// The name as stores and exported files tell it from others: SQLite knows no case, and netCDF few
/// signs.
std::string stored_name(const std::string& name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte >= 128 ? c : std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  return text;
}

void require_distinct_factors(const Study& study) {
  std::map<std::string, std::string> taken;
  for (const Group& group : study.groups) {
    for (const Factor& factor : group.factors) {
      const std::string name = Axis(factor).name();
      const std::string& other = taken.emplace(stored_name(name), name).first->second;
      if (other == name) continue;
      throw InputError(factor.origin, "the factors \"" + other + "\" and \"" + name +
                                          "\" would have one column: names differ in letters and "
                                          "digits, whatever their case; give it another name");
    }
  }
}

std::vector<CellSelection> exclusions(const Group& group) {
  std::vector<CellSelection> all;
  if (const auto* list = std::get_if<Setting::List>(&group.exclude.value)) {
    for (const Setting& entry : *list) all.emplace_back(entry);
  }
  return all;
}

}  // namespace

TrialGroup::TrialGroup(const Group& group, std::int64_t replications)
    : group_(group), replications_(replications), sampled_(group.design.make()->draws()) {
  if (sampled_) {
    columns_.emplace_back(sample_column);
    units_.emplace_back();
  }
  std::vector<int> levels;
  for (const Factor& factor : group.factors) {
    axes_.emplace_back(factor);
    only_.emplace_back(factor.only);
    const std::string& name = axes_.back().name();
    if (is_taken(name)) {
      throw InputError(factor.origin, "a factor cannot be called \"" + name +
                                          "\", as every stored trial has a column of that name; "
                                          "give it another name");
    }
    if (std::ranges::find(columns_, name) != columns_.end()) {
      throw InputError(factor.origin, "there are two factors \"" + name + "\"; name one of them");
    }
    for (const auto& [other, wanted] : only_.back().wanted()) {
      if (other != name && std::ranges::find(columns_, other) != columns_.end()) continue;
      throw InputError(
          factor.origin,
          "only names \"" + other + "\", which is no factor that stands before \"" + name + '"');
    }
    columns_.push_back(name);
    units_.push_back(axes_.back().unit());
    levels.push_back(axes_.back().levels());
  }
  design_ = group.design.make()->cells(levels);

  const std::vector<CellSelection> excluded = exclusions(group);
  for (const CellSelection& selection : excluded) {
    for (const auto& [name, wanted] : selection.wanted()) {
      if (std::ranges::find(columns_, name) != columns_.end()) continue;
      throw InputError(selection.origin(), "exclude names \"" + name + "\", which is no factor" +
                                               suggestion(name, columns_));
    }
  }
  std::set<std::vector<std::string>> seen;
  for (Eigen::Index row = 0; row < design_.rows(); ++row) {
    std::vector<std::string> labels = labels_of(row);
    const bool out = std::ranges::any_of(
        excluded, [&](const CellSelection& s) { return s.holds(columns_, labels); });
    // Levels of a factor that does not apply fall together into one cell.
    if (out || !seen.insert(labels).second) continue;
    rows_.push_back(row);
    labels_.push_back(std::move(labels));
  }
  if (sampled_ && !excluded.empty()) {
    throw InputError(group.origin,
                     "a design that draws its cells takes no exclude: its analysis "
                     "needs all of them");
  }
  if (rows_.empty()) throw InputError(group.origin, "every cell of the group is excluded");
}

std::vector<std::string> TrialGroup::labels_of(Eigen::Index row) const {
  std::vector<std::string> labels;
  if (sampled_) labels.push_back(std::to_string(row + 1));
  for (std::size_t f = 0; f < axes_.size(); ++f) {
    const bool applies = only_[f].holds(std::span(columns_).first(labels.size()), labels);
    labels.push_back(applies ? axes_[f].at(design_(row, static_cast<Eigen::Index>(f))).label
                             : std::string(not_applied));
  }
  return labels;
}

std::vector<Axis::Place> TrialGroup::changes(std::size_t cell) const {
  std::vector<Axis::Place> changes;
  const std::size_t first = sampled_ ? 1 : 0;
  for (std::size_t f = 0; f < axes_.size(); ++f) {
    if (labels_[cell][first + f] == not_applied) continue;
    changes.push_back(axes_[f].at(design_(rows_[cell], static_cast<Eigen::Index>(f))));
  }
  return changes;
}

std::string TrialGroup::title(std::size_t cell) const {
  std::string title;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (labels_[cell][i] == not_applied) continue;
    title += (title.empty() ? "" : ", ") + columns_[i] + " = " + labels_[cell][i];
  }
  return title;
}

std::string TrialGroup::key(std::size_t cell, int replication) const {
  std::string key = name();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    key += "|" + columns_[i] + "=" + labels_[cell][i];
  }
  return key + "|" + std::to_string(replication);
}

TrialList::TrialList(const Study& study) : study_(study) {
  require_distinct_factors(study);
  for (const Group& group : study.groups) {
    const std::int64_t replications =
        group.replications > 0 ? group.replications : study.replications;
    groups_.emplace_back(group, replications);
    const double trials =
        static_cast<double>(groups_.back().cells()) * static_cast<double>(replications) +
        static_cast<double>(trials_.size());
    if (trials > most_trials) {
      throw InputError(group.origin, "the study has " + shortest(trials) +
                                         " trials, and may have " + shortest(most_trials) +
                                         "; ask for fewer replications, levels or samples");
    }
    first_trial_.push_back(trials_.size());
    for (std::size_t cell = 0; cell < groups_.back().cells(); ++cell) {
      for (int k = 0; k < replications; ++k) trials_.push_back({groups_.size() - 1, cell, k});
    }
  }
}

std::size_t TrialList::index(std::size_t group, std::size_t cell, int replication) const {
  return first_trial_[group] + cell * static_cast<std::size_t>(groups_[group].replications()) +
         static_cast<std::size_t>(replication);
}

std::vector<std::size_t> TrialList::part(int shard, int shards) const {
  std::vector<std::size_t> places;
  for (auto i = static_cast<std::size_t>(shard - 1); i < trials_.size();
       i += static_cast<std::size_t>(shards)) {
    places.push_back(i);
  }
  return places;
}

std::string TrialList::title(const ListedTrial& trial) const {
  const TrialGroup& group = groups_[trial.group];
  std::string title = group.name();
  const std::string cell = group.title(trial.cell);
  if (!cell.empty()) title += (title.empty() ? "" : ", ") + cell;
  return title + (title.empty() ? "" : ", ") + "seed " + std::to_string(seed(trial));
}

}  // namespace shoal::analysis
