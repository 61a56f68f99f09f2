#include "shoal/analysis/experiments/claims/claim_scope.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/slices.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::vector<std::size_t> groups_of(const TestedStatement& asked, const TrialList& list) {
  if (asked.groups.empty() && list.groups().size() > 1) {
    throw InputError(asked.origin, "the study has several groups; say which the claim is about");
  }
  return places_of_groups(asked.groups, list, asked.origin);
}

void require_column(const std::string& name, const TrialGroup& group, const Origin& origin) {
  if (name == group_column || contains(group.columns(), name)) return;
  const std::string owner = group.name().empty() ? "the study" : "the group " + group.name();
  throw InputError(origin,
                   owner + " has no factor \"" + name + '"' + suggestion(name, group.columns()));
}

void require_columns(const CellSelection& selection, const TrialGroup& group,
                     const Origin& origin) {
  for (const std::string& name : selection.factors()) require_column(name, group, origin);
}

/// Whether a selection holds a cell, of which the group is one more factor.
bool holds(const CellSelection& selection, const TrialGroup& group, std::size_t cell) {
  std::vector<std::string> names = group.columns();
  std::vector<std::string> labels(group.labels(cell).begin(), group.labels(cell).end());
  names.emplace_back(group_column);
  labels.push_back(group.name());
  return selection.holds(names, labels);
}

struct TrialNumber {
  std::optional<double> value;
  bool never_reached = false;  ///< the value is what an event that did not come is bounded by
};

TrialNumber trial_number(const TestedStatement& asked, const StudyResults& results,
                         std::size_t trial) {
  TrialNumber number;
  const auto answer = [&](const std::string& name, double at_s) {
    const Answer given = results.answer(
        asked.series.empty() ? Question{name, "", "", 0.0} : Question{"", name, "", at_s}, trial);
    number.never_reached |= given.kind == Answer::Kind::never_reached;
    return given.bounded();
  };
  const auto at = [&](double time_s) {
    std::optional<double> value =
        answer(asked.series.empty() ? asked.measure : asked.series, time_s);
    if (!value || asked.minus.empty()) return value;
    const std::optional<double> other = answer(asked.minus, time_s);
    return other ? std::optional(*value - *other) : std::nullopt;
  };
  number.value = at(asked.at_s);
  if (!number.value || !asked.of_a_change()) return number;
  const std::optional<double> before = at(asked.since_s);
  number.value = before ? std::optional(*number.value - *before) : std::nullopt;
  return number;
}

/// Times to an event are known up to the shortest watch that did not see it: beyond, all count as
/// that, so that means over trials are restricted means.
void restrict_times(SharedNumbers& shared, double horizon_s) {
  for (std::vector<double>& of_cell : shared.of) {
    for (double& time_s : of_cell) time_s = std::min(time_s, horizon_s);
  }
}

}  // namespace

std::vector<ClaimScope> claim_scopes(const TestedStatement& asked, const Setting& where,
                                     const StudyResults& results,
                                     const std::vector<std::string>& compared) {
  const CellSelection selection(where);
  std::vector<ClaimScope> scopes;
  const std::vector<std::size_t> groups = groups_of(asked, results.list());
  const bool tell_groups = groups.size() > 1 && !contains(compared, group_column);
  std::map<std::string, std::size_t> known;  // title of the fixed factors -> scope
  for (const std::size_t g : groups) {
    const TrialGroup& group = results.list().groups()[g];
    require_columns(selection, group, asked.origin);
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      if (!holds(selection, group, cell)) continue;
      std::string title = tell_groups ? group.name() : "";
      for (std::size_t i = 0; i < group.columns().size(); ++i) {
        const std::string& column = group.columns()[i];
        if (contains(compared, column) || selection.names_one(column)) continue;
        title += (title.empty() ? "" : ", ") + group.labels(cell)[i];
      }
      const auto [place, fresh] = known.emplace(title, scopes.size());
      if (fresh) scopes.push_back({results, asked, {}, title});
      scopes[place->second].cells.push_back({g, cell});
    }
  }
  if (scopes.empty()) throw InputError(asked.origin, "no cell of the study is as `where` says");
  return scopes;
}

std::vector<std::string> levels_of(const std::string& factor, const TestedStatement& asked,
                                   const TrialList& list) {
  const CellSelection where(asked.where);
  std::vector<std::string> levels;
  for (const std::size_t g : groups_of(asked, list)) {
    const TrialGroup& group = list.groups()[g];
    require_column(factor, group, asked.origin);
    require_columns(where, group, asked.origin);
    const auto column = static_cast<std::size_t>(std::ranges::find(group.columns(), factor) -
                                                 group.columns().begin());
    for (std::size_t cell = 0; cell < group.cells(); ++cell) {
      const std::string& label = group.labels(cell)[column];
      if (holds(where, group, cell) && !contains(levels, label)) levels.push_back(label);
    }
  }
  if (levels.empty()) throw InputError(asked.origin, "no cell of the study is as `where` says");
  return levels;
}

CellPlace ClaimScope::cell(const CellSelection& selection) const {
  std::optional<CellPlace> found;
  for (const CellPlace candidate : cells) {
    const TrialGroup& group = results.list().groups()[candidate.group];
    require_columns(selection, group, selection.origin());
    if (!holds(selection, group, candidate.cell)) continue;
    if (found) {
      throw InputError(selection.origin(), "several cells have " + selection.text() +
                                               "; name more factors, here or in where");
    }
    found = candidate;
  }
  if (!found) {
    throw InputError(selection.origin(),
                     "no cell has " + selection.text() + (title.empty() ? "" : " with " + title));
  }
  return *found;
}

std::string ClaimScope::label(CellPlace place, const std::vector<std::string>& factors) const {
  const TrialGroup& group = results.list().groups()[place.group];
  std::string text;
  for (std::size_t i = 0; i < group.columns().size(); ++i) {
    if (!contains(factors, group.columns()[i])) continue;
    text += (text.empty() ? "" : ", ") + group.columns()[i] + " = " + group.labels(place.cell)[i];
  }
  if (!contains(factors, group_column)) return text;
  return std::string(group_column) + " = " + group.name() + (text.empty() ? "" : ", ") + text;
}

SharedNumbers ClaimScope::numbers(const std::vector<CellPlace>& places) const {
  SharedNumbers shared{.of = std::vector<std::vector<double>>(places.size())};
  const auto replications = [&](CellPlace place) {
    return results.list().groups()[place.group].replications();
  };
  shared.trials = replications(*std::ranges::min_element(places, {}, replications));
  double horizon_s = std::numeric_limits<double>::infinity();
  for (int k = 0; k < shared.trials; ++k) {
    std::vector<double> row;
    bool never_reached = false;
    for (const CellPlace place : places) {
      const TrialNumber number =
          trial_number(asked, results, results.list().index(place.group, place.cell, k));
      if (!number.value) break;
      row.push_back(*number.value);
      never_reached |= number.never_reached;
      if (number.never_reached) horizon_s = std::min(horizon_s, *number.value);
    }
    if (row.size() < places.size()) continue;
    for (std::size_t i = 0; i < row.size(); ++i) shared.of[i].push_back(row[i]);
    if (never_reached) ++shared.never_reached;
  }
  const bool times = asked.series.empty() && asked.minus.empty() &&
                     !known_value(asked.measure, asked.origin).censored_by.empty();
  if (times) restrict_times(shared, horizon_s);
  return shared;
}

}  // namespace shoal::analysis
