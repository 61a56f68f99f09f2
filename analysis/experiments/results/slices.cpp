#include "shoal/analysis/experiments/results/slices.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::size_t place_of(const std::vector<std::string>& labels, const std::string& label) {
  return static_cast<std::size_t>(std::ranges::find(labels, label) - labels.begin());
}

struct SelectedCell {
  std::size_t group, cell;
  std::vector<std::size_t> labels;  ///< one a dimension of all, by its place there
};

/// All that could be a dimension, and the cells that a scope selects.
struct Selected {
  std::vector<Dimension> all;
  std::vector<SelectedCell> cells;
};

std::vector<std::string> names_of(const std::vector<Dimension>& dimensions) {
  std::vector<std::string> names;
  for (const Dimension& dimension : dimensions) names.push_back(dimension.name);
  return names;
}

Selected selected(const TrialList& list, const Scope& scope) {
  Selected selected;
  const std::vector<std::size_t> groups = places_of_groups(scope.groups, list, scope.origin);
  if (groups.size() > 1) selected.all.push_back({group_column, "", {}});
  for (const std::size_t g : groups) {
    const TrialGroup& group = list.groups()[g];
    for (std::size_t i = 0; i < group.columns().size(); ++i) {
      if (contains(names_of(selected.all), group.columns()[i])) continue;
      selected.all.push_back({group.columns()[i], group.units()[i], {}});
    }
  }
  const std::vector<std::string> names = names_of(selected.all);
  std::vector<std::unordered_map<std::string, std::size_t>> known(names.size());
  for (const auto& [name, labels] : scope.where.wanted()) {
    if (contains(names, name)) continue;
    throw InputError(
        scope.origin,
        "where names \"" + name + "\", which is no factor of the groups" + suggestion(name, names));
  }
  for (const std::size_t g : groups) {
    const TrialGroup& group = list.groups()[g];
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      std::vector<std::string> labels(names.size());  // "" where the group has no such factor
      for (std::size_t d = 0; d < names.size(); ++d) {
        if (groups.size() > 1 && d == 0) {
          labels[d] = group.name();
        } else if (contains(group.columns(), names[d])) {
          labels[d] = group.labels(cell)[place_of(group.columns(), names[d])];
        }
      }
      if (!scope.where.holds(names, labels)) continue;
      SelectedCell& member = selected.cells.emplace_back(SelectedCell{g, cell, {}});
      for (std::size_t d = 0; d < names.size(); ++d) {
        const auto [at, fresh] = known[d].emplace(labels[d], known[d].size());
        if (fresh) selected.all[d].labels.push_back(labels[d]);
        member.labels.push_back(at->second);
      }
    }
  }
  if (selected.cells.empty()) {
    throw InputError(scope.origin, "no cell of the study has " + scope.where.text());
  }
  return selected;
}

}  // namespace

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<std::size_t> places_of_groups(const std::vector<std::string>& names,
                                          const TrialList& list, const Origin& origin) {
  std::vector<std::string> known;
  for (const TrialGroup& group : list.groups()) known.push_back(group.name());
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    if (!contains(known, name)) {
      throw InputError(origin, "the study has no group \"" + name + '"' + suggestion(name, known));
    }
    places.push_back(place_of(known, name));
  }
  if (names.empty()) {
    places.resize(known.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
  }
  return places;
}

std::vector<statistics::EventTime> Sample::event_times() const {
  std::vector<statistics::EventTime> event_times;
  for (std::size_t k = 0; k < values.size(); ++k) event_times.push_back({values[k], reached[k]});
  return event_times;
}

double Sample::horizon() const {
  if (!times) return std::numeric_limits<double>::infinity();
  const std::vector<std::vector<statistics::EventTime>> alone{event_times()};
  return statistics::common_horizon(alone);
}

std::vector<double> Sample::restricted(double horizon) const {
  return times ? statistics::restricted_times(event_times(), horizon) : values;
}

statistics::Differences Sample::minus(const Sample& other) const {
  const double common = std::min(horizon(), other.horizon());
  const std::vector<double> own = restricted(common), all_theirs = other.restricted(common);
  std::vector<double> ours, theirs;
  std::map<std::string, double> others;
  for (std::size_t k = 0; k < all_theirs.size(); ++k) others[other.pairs[k]] = all_theirs[k];
  for (std::size_t k = 0; k < own.size(); ++k) {
    const auto found = others.find(pairs[k]);
    if (found == others.end()) continue;
    ours.push_back(own[k]);
    theirs.push_back(found->second);
  }
  return statistics::Differences::between(ours, theirs);
}

std::optional<int> Sample::reached_count() const {
  if (!waits) return std::nullopt;
  return static_cast<int>(std::ranges::count(reached, true));
}

Slices::Slices(const StudyResults& results, const Scope& scope) : results_(results) {
  const TrialList& list = results.list();
  const Selected found = selected(list, scope);
  const std::vector<std::string> names = names_of(found.all);
  for (const auto* wanted : {&scope.kept, &scope.pooled}) {
    for (const std::string& name : *wanted) {
      if (contains(names, name)) continue;
      throw InputError(scope.origin,
                       "there is no factor \"" + name + "\" to show" + suggestion(name, names));
    }
  }
  std::vector<std::size_t> kept;
  for (const std::string& name : scope.kept) kept.push_back(place_of(names, name));
  std::vector<std::size_t> pooled;
  for (std::size_t d = 0; d < names.size(); ++d) {
    if (contains(scope.kept, names[d])) continue;
    if (contains(scope.pooled, names[d])) {
      pooled.push_back(d);
    } else if (found.all[d].labels.size() > 1 && scope.keep_rest) {
      kept.push_back(d);
    } else if (found.all[d].labels.size() > 1) {
      throw InputError(scope.origin, "the factor " + names[d] + " has several levels here (" +
                                         listed(found.all[d].labels) +
                                         "); name it in rows or columns, choose one with where, or "
                                         "take them together with pool");
    }
  }
  for (const std::size_t d : kept) dimensions_.push_back(found.all[d]);

  for (const SelectedCell& cell : found.cells) {
    std::vector<std::size_t> place;
    for (const std::size_t d : kept) place.push_back(cell.labels[d]);
    std::string pair;
    for (const std::size_t d : pooled) pair += std::to_string(cell.labels[d]) + "|";
    std::vector<Member>& members = trials_[place];
    for (int k = 0; k < list.groups()[cell.group].replications(); ++k) {
      members.push_back({list.index(cell.group, cell.cell, k), pair + std::to_string(k)});
    }
  }
  for (const auto& [place, members] : trials_) places_.push_back(place);
}

Sample Slices::sample(const std::vector<std::size_t>& place, const Question& question) const {
  Sample sample;
  const auto found = trials_.find(place);
  if (found == trials_.end()) return sample;
  const auto known = std::ranges::find(known_values(), question.measure, &Quantity::name);
  if (known != known_values().end()) {
    sample.times = !known->censored_by.empty();
    sample.waits = sample.times || !known->event.empty();
  }
  for (const Member& member : found->second) {
    const Answer answer = results_.answer(question, member.trial);
    if (answer.kind == Answer::Kind::failed) ++sample.failed;
    if (answer.kind == Answer::Kind::not_run) ++sample.not_run;
    if (!answer.has_number()) continue;
    sample.values.push_back(answer.number);
    sample.pairs.push_back(member.pair);
    sample.reached.push_back(answer.kind == Answer::Kind::value);
  }
  return sample;
}

}  // namespace shoal::analysis
