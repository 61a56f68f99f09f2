#include "shoal/analysis/study/export.hpp"

#include <algorithm>
#include <set>

#include "shoal/analysis/measure.hpp"
#include "shoal/analysis/study/cells.hpp"
#include "shoal/analysis/study/study_files.hpp"
#include "shoal/analysis/tables/csv_line.hpp"
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

/// The factors of all groups, in the order in which they first stand, with their units.
std::vector<std::pair<std::string, std::string>> all_factors(const StudyPlan& plan) {
  std::vector<std::pair<std::string, std::string>> factors;
  for (const PlannedGroup& group : plan.groups()) {
    for (std::size_t c = 0; c < group.columns().size(); ++c) {
      const std::pair factor(group.columns()[c], group.units()[c]);
      if (std::ranges::find(factors, factor) == factors.end()) factors.push_back(factor);
    }
  }
  return factors;
}

std::string label_in(const PlannedGroup& group, std::size_t cell,
                     const std::pair<std::string, std::string>& factor) {
  for (std::size_t c = 0; c < group.columns().size(); ++c) {
    if (group.columns()[c] != factor.first || group.units()[c] != factor.second) continue;
    const std::string& label = group.labels(cell)[c];
    return label == not_applied ? std::string() : label;
  }
  return "";
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
    : StudyExport(stored_plan(folder), Store(folder, Store::Access::read)) {}

StudyExport::StudyExport(const StudyPlan& plan, const Store& store)
    : metrics_(in_declared_order(store.metric_names(), known_values())),
      series_(in_declared_order(store.series_names(), known_series())),
      results_(plan, store, metrics_, series_) {}

std::string StudyExport::csv() const {
  const StudyPlan& plan = results_.plan();
  const auto factors = all_factors(plan);
  std::vector<std::string> fields{"study_group"};
  for (const auto& [name, unit] : factors) fields.push_back(name_with_unit(name, unit));
  for (const char* name : {"replication", "seed", "status", "reason"}) fields.emplace_back(name);
  fields.insert(fields.end(), metrics_.begin(), metrics_.end());
  std::set<std::string> seen;
  for (const std::string& name : fields) {
    if (seen.insert(name).second) continue;
    throw InputError("two columns of the trials would be called \"" + name +
                     "\"; give one of the factors another name");
  }

  std::string text = csv_line(fields);
  for (std::size_t i = 0; i < plan.trials(); ++i) {
    const PlannedTrial& trial = plan.trial(i);
    const PlannedGroup& group = plan.groups()[trial.group];
    fields = {group.name()};
    for (const auto& factor : factors) fields.push_back(label_in(group, trial.cell, factor));
    fields.push_back(std::to_string(trial.replication + 1));
    fields.push_back(std::to_string(plan.seed(trial)));
    fields.emplace_back(status_of(results_.state(i)));
    fields.push_back(results_.failure(i));
    for (const std::string& metric : metrics_) {
      const std::optional<double> value = results_.answer({.metric = metric}, i);
      fields.push_back(value ? shortest(*value) : "");
    }
    text += csv_line(fields);
  }
  return text;
}

}  // namespace shoal::analysis
