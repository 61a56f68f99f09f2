#include "shoal/analysis/reporting/export.hpp"

#include <algorithm>
#include <set>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/results/cells.hpp"
#include "shoal/analysis/experiments/study/study_files.hpp"
#include "shoal/core/csv_line.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

/// Of several stores of one study the same, whichever trial was stored first: as the measures
/// declare them, then what they do not know.
std::vector<std::string> in_declared_order(std::vector<std::string> names,
                                           const std::vector<Quantity>& known) {
  std::vector<std::string> ordered;
  for (const Quantity& quantity : known) {
    const auto found = std::ranges::find(names, quantity.name);
    if (found == names.end()) continue;
    ordered.push_back(quantity.name);
    names.erase(found);
  }
  std::ranges::sort(names);
  ordered.insert(ordered.end(), names.begin(), names.end());
  return ordered;
}

std::vector<std::string> factor_columns(const TrialGroup& group) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < group.columns().size(); ++c) {
    names.push_back(name_with_unit(group.columns()[c], group.units()[c]));
  }
  return names;
}

/// Of all groups, in the order in which they first stand. Factors of several groups that are called
/// alike share a column. Throws InputError if two of one group do, or one and something else.
std::vector<std::string> all_factor_columns(const TrialList& list,
                                            const std::vector<std::string>& others) {
  std::vector<std::string> columns;
  for (const TrialGroup& group : list.groups()) {
    std::set<std::string> taken(others.begin(), others.end());
    for (const std::string& name : factor_columns(group)) {
      if (!taken.insert(name).second) {
        throw InputError(group.group().origin, "two columns of the trials would be called \"" +
                                                   name + "\"; give a factor another name");
      }
      if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
    }
  }
  return columns;
}

/// Empty where the group has no such factor, or where it does not apply.
std::string label_in(const TrialGroup& group, std::size_t cell, const std::string& column) {
  const std::vector<std::string> columns = factor_columns(group);
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return "";
  const std::string& label = group.labels(cell)[static_cast<std::size_t>(found - columns.begin())];
  return label == not_applied ? std::string() : label;
}

const char* status_of(StudyResults::State state) {
  switch (state) {
    case StudyResults::State::missing:
      return "missing";
    case StudyResults::State::failed:
      return "failed";
    case StudyResults::State::done:
      return "done";
  }
  return "";
}

}  // namespace

StudyExport::StudyExport(const std::filesystem::path& folder)
    : StudyExport(stored_list(folder), Store(folder, Store::Access::read)) {}

StudyExport::StudyExport(const TrialList& list, const Store& store)
    : measures_(in_declared_order(store.measure_names(), known_values())),
      series_(in_declared_order(store.series_names(), known_series())),
      results_(list, store, measures_, series_) {}

std::string StudyExport::csv() const {
  const TrialList& list = results_.list();
  const std::vector<std::string> fate{"replication", "seed", "status", "reason"};
  std::vector<std::string> others{"study_group"};
  others.insert(others.end(), fate.begin(), fate.end());
  others.insert(others.end(), measures_.begin(), measures_.end());
  const std::vector<std::string> factors = all_factor_columns(list, others);
  std::vector<std::string> fields{"study_group"};
  for (const auto* names : {&factors, &fate, &measures_}) {
    fields.insert(fields.end(), names->begin(), names->end());
  }

  std::string text = csv_line(fields);
  for (std::size_t i = 0; i < list.trials(); ++i) {
    const ListedTrial& trial = list.trial(i);
    const TrialGroup& group = list.groups()[trial.group];
    fields = {group.name()};
    for (const std::string& column : factors) {
      fields.push_back(label_in(group, trial.cell, column));
    }
    fields.push_back(std::to_string(trial.replication + 1));
    fields.push_back(std::to_string(list.seed(trial)));
    fields.emplace_back(status_of(results_.state(i)));
    fields.push_back(results_.failure(i));
    for (const std::string& measure : measures_) {
      const std::optional<double> value = results_.stored(measure, i);
      fields.push_back(value ? shortest(*value) : "");
    }
    text += csv_line(fields);
  }
  return text;
}

}  // namespace shoal::analysis
