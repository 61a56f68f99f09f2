#include "shoal/analysis/experiments/store/stored_union.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>

#include "shoal/analysis/experiments/store/planned_trial.hpp"
#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

namespace fs = std::filesystem;

const char* const remedy =
    "; leave one of them out, or run it again with shoal sweep --rerun-changed";

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, {}, std::bit_cast<std::uint64_t, double>,
                            std::bit_cast<std::uint64_t, double>);
}

std::map<std::string, double> values_of(const StoredTrial& trial) {
  std::map<std::string, double> values;
  for (const auto& [name, value] : trial.measures) {
    if (value) values.emplace(name, *value);
  }
  return values;
}

std::string text_of(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "null" : shortest(found->second);
}

std::string outcome_of(const StoredTrial& trial) {
  return trial.failed() ? "failed (" + trial.failure + ")" : "is done";
}

}  // namespace

std::optional<std::string> difference(const StoredTrial& a, const StoredTrial& b) {
  if (a.failure != b.failure) {
    return "it " + outcome_of(a) + " in the first, and " + outcome_of(b) + " in the second";
  }
  if (a.seed != b.seed) {
    return "its seed is " + std::to_string(a.seed) + " in the first, and " +
           std::to_string(b.seed) + " in the second";
  }
  const std::map<std::string, double> in_a = values_of(a), in_b = values_of(b);
  for (const auto* values : {&in_a, &in_b}) {
    for (const auto& [name, value] : *values) {
      const std::string one = text_of(in_a, name), other = text_of(in_b, name);
      if (one != other) {
        return name + " is " + one + " in the first, and " + other + " in the second";
      }
    }
  }
  for (const scenarios::Series& series : a.series) {
    const auto found = std::ranges::find(b.series, series.name, &scenarios::Series::name);
    if (found == b.series.end()) continue;
    if (!same_bits(series.time_s, found->time_s) || !same_bits(series.values, found->values)) {
      return "the numbers of the series " + series.name + " are others in the second";
    }
  }
  return std::nullopt;
}

StoredUnion::StoredUnion(const TrialList& list, Store& store, const fs::path& folder)
    : list_(list), store_(store), folders_{{.folder = folder}} {
  for (std::size_t i = 0; i < list.trials(); ++i) {
    const ListedTrial& trial = list.trial(i);
    places_.emplace(list.groups()[trial.group].key(trial.cell, trial.replication), i);
  }
  store.visit(
      [&](const StoredTrial& trial) {
        const std::optional<std::size_t> place = place_of(trial);
        ++(place ? folders_.front().trials : folders_.front().others);
        if (!place) return;
        note(trial, {0, *place, trial.scenario});
      },
      std::vector<std::string>{});
  folders_.front().taken = folders_.front().trials;
}

std::optional<std::size_t> StoredUnion::place_of(const StoredTrial& trial) const {
  const auto found = places_.find(trial.key);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

void StoredUnion::note(const StoredTrial& trial, const Seen& seen) {
  require_as_planned(trial, seen);
  require_one_program(trial, seen);
  require_one_scenario(trial, seen);
  if (known_.emplace(trial.key, seen).second) failed_ += trial.failed() ? 1 : 0;
}

void StoredUnion::require_as_planned(const StoredTrial& trial, const Seen& seen) const {
  const std::optional<std::string> wrong = contradiction(list_, list_.trial(seen.trial), trial);
  if (!wrong) return;
  throw InputError({(folders_[seen.folder].folder / "trials.sqlite").string()},
                   "the trial " + trial.key + ": " + *wrong + remedy);
}

void StoredUnion::require_one_program(const StoredTrial& trial, const Seen& seen) {
  if (!first_) {
    first_ = seen;
    program_ = trial.program;
  }
  if (trial.program == program_) return;
  throw InputError(title(seen.trial) + " was run by shoal " + trial.program + " in " +
                   folders_[seen.folder].folder.string() + ", and " + title(first_->trial) +
                   " by shoal " + program_ + " in " + folders_[first_->folder].folder.string() +
                   remedy);
}

void StoredUnion::require_one_scenario(const StoredTrial& trial, const Seen& seen) {
  const ListedTrial& planned = list_.trial(seen.trial);
  const Seen& before =
      of_cell_.emplace(list_.index(planned.group, planned.cell, 0), seen).first->second;
  if (before.scenario == trial.scenario) return;
  throw InputError(title(seen.trial) + " was run in another scenario in " +
                   folders_[seen.folder].folder.string() + " than " + title(before.trial) + " in " +
                   folders_[before.folder].folder.string() +
                   ": the base scenario had changed, or a file it names" + remedy);
}

void StoredUnion::require_same(const StoredTrial& ours, const StoredTrial& theirs, const Seen& seen,
                               const fs::path& folder) const {
  const std::optional<std::string> what = difference(ours, theirs);
  if (!what) return;
  throw InputError(title(seen.trial) + " differs between " + folders_[seen.folder].folder.string() +
                   " and " + folder.string() + ": " + *what + remedy);
}

MergedFolder StoredUnion::add(const fs::path& folder) {
  const Store other(folder, Store::Access::read);
  const std::size_t index = folders_.size();
  folders_.push_back({.folder = folder});
  other.visit([&](StoredTrial& trial) {
    const std::optional<std::size_t> place = place_of(trial);
    ++(place ? folders_[index].trials : folders_[index].others);
    if (!place) return;
    trial.series = other.series_of(trial.key);
    const bool is_new = !known_.contains(trial.key);
    note(trial, {index, *place, trial.scenario});
    if (is_new) {
      ++folders_[index].taken;
      store_.write(trial);
      return;
    }
    StoredTrial ours = store_.find(trial.key).value();
    ours.series = store_.series_of(trial.key);
    require_same(ours, trial, known_.at(trial.key), folder);
    // One of them may have run before the study asked for a series.
    const std::size_t before = ours.series.size();
    for (const scenarios::Series& series : trial.series) {
      const auto has = std::ranges::find(ours.series, series.name, &scenarios::Series::name);
      if (has == ours.series.end()) ours.series.push_back(series);
    }
    if (ours.series.size() > before) store_.write(ours);
  });
  return folders_[index];
}

std::string StoredUnion::title(std::size_t trial) const {
  const ListedTrial& planned = list_.trial(trial);
  const TrialGroup& group = list_.groups()[planned.group];
  std::string text;
  for (const std::string& part : {group.name(), group.title(planned.cell)}) {
    if (!part.empty()) text += part + ", ";
  }
  return text + "replication " + std::to_string(planned.replication + 1);
}

}  // namespace shoal::analysis
