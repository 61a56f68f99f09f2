#include "shoal/analysis/trial.hpp"

#include <chrono>
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

}  // namespace

double Trial::vehicle_seconds_per_wall_s() const {
  return static_cast<double>(world->size()) * world->time_s() / wall_s;
}

Trial run_trial(const scenarios::Scenario& scenario, const TrialSettings& settings) {
  Trial trial{.scenario = scenario, .results = {}, .world = nullptr, .record = nullptr};
  trial.world =
      std::make_unique<scenarios::World>(scenario, settings.threads, settings.behaviour_hook);

  std::vector<std::unique_ptr<Measure>> measures = all_measures();
  std::vector<scenarios::Observer*> observers = settings.observers;
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

  for (const auto& measure : measures) conclude(*measure, *trial.world, trial.results);
  return trial;
}

}  // namespace shoal::analysis
