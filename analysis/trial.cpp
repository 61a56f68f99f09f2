#include "shoal/analysis/trial.hpp"

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace shoal::analysis {
namespace {

std::vector<std::unique_ptr<Measure>> all_measures() {
  std::vector<std::unique_ptr<Measure>> measures;
  const auto& registry = Registry<Measure>::instance();
  for (const MemberInfo& member : registry.members()) {
    measures.push_back(registry.make(member.name, Setting{}, member.name));
  }
  return measures;
}

[[noreturn]] void undeclared(const std::string& name) {
  throw std::logic_error("a measure must yield what it declares, in that order; see " + name);
}

/// What a measure says, checked against its declaration, which also gives units and meanings.
void finish(const Measure& measure, const scenarios::World& world, Results& results) {
  const std::vector<Quantity> values = measure.values(), series = measure.series();
  const std::size_t first_value = results.values.size(), first_series = results.series.size();
  measure.finish(world, results);
  if (results.values.size() != first_value + values.size()) undeclared("a number of values");
  if (results.series.size() != first_series + series.size()) undeclared("a number of series");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [name, value] = results.values[first_value + i];
    if (name != values[i].name) undeclared(name);
    if (value && !std::isfinite(*value)) throw std::logic_error(name + " is not finite");
  }
  for (std::size_t i = 0; i < series.size(); ++i) {
    scenarios::Series& added = results.series[first_series + i];
    if (added.name != series[i].name) undeclared(added.name);
    added.unit = series[i].unit;
    added.meaning = series[i].meaning;
  }
}

}  // namespace

double Trial::vehicle_seconds_per_wall_s() const {
  return static_cast<double>(world->size()) * world->time_s() / wall_s;
}

Trial run_trial(const scenarios::Scenario& scenario, const TrialSettings& settings) {
  Trial trial{.scenario = scenario, .results = {}, .world = nullptr, .record = nullptr};
  trial.world =
      std::make_unique<scenarios::World>(scenario, settings.threads, settings.behaviour_hook);

  std::vector<std::unique_ptr<Measure>> measures = all_measures();
  std::vector<scenarios::Observer*> observers;
  for (const auto& measure : measures) {
    measure->begin(*trial.world);
    if (measure->every_s() > 0.0) observers.push_back(measure.get());
  }
  if (settings.record && scenario.trial.record_every_s > 0.0) {
    trial.record = std::make_unique<scenarios::TrialRecord>(scenario.trial.record_every_s);
    observers.push_back(trial.record.get());
  }

  const auto began = std::chrono::steady_clock::now();
  trial.world->run(observers);
  trial.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  for (const auto& measure : measures) finish(*measure, *trial.world, trial.results);
  return trial;
}

}  // namespace shoal::analysis
