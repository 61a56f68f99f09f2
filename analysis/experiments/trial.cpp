#include "shoal/analysis/experiments/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

std::vector<std::unique_ptr<Measure>> all_measures(const MemberOptions& options) {
  std::vector<std::unique_ptr<Measure>> measures;
  const auto& registry = Registry<Measure>::instance();
  for (const MemberInfo& member : registry.members()) {
    measures.push_back(
        registry.make(member.name, options.of(member.name), "measure." + member.name));
  }
  return measures;
}

}  // namespace

void require_holdable(const scenarios::World& world, bool record) {
  constexpr double most = 1e9;
  const scenarios::Scenario& scenario = world.scenario();
  const auto require = [&](double every_s, double each, const char* key) {
    if (every_s <= 0.0) return;
    const double numbers = scenario.trial.duration_s / every_s * each;
    if (numbers <= most) return;
    throw InputError(std::string(key) + " is " + shortest(every_s) + " s, and trial.duration_s " +
                     shortest(scenario.trial.duration_s) + " s: that is " + shortest(numbers) +
                     " numbers to keep, and at most " + shortest(most) +
                     " are; raise the one, or shorten the other");
  };
  const double of_each_vehicle = scenarios::TrialRecord::numbers_of_each_vehicle();
  if (record) {
    require(scenario.trial.record_every_s, of_each_vehicle * static_cast<double>(world.size()),
            "trial.record_every_s");
  }
  require(scenario.quality.every_s, static_cast<double>(known_series().size()), "quality.every_s");
}

double watching_interval_s(const scenarios::Scenario& scenario) {
  const double tick_s = scenario.trial.tick_s;
  return tick_s * std::max(1.0, std::floor(5.0 / tick_s));
}

double Trial::vehicle_seconds_per_wall_s() const {
  return static_cast<double>(world->size()) * world->time_s() / wall_s;
}

Trial run_trial(const scenarios::Scenario& scenario, const TrialSettings& settings) {
  Trial trial{.scenario = scenario, .results = {}, .world = nullptr, .record = nullptr};
  trial.world = std::make_unique<scenarios::World>(scenario, settings.threads);

  require_holdable(*trial.world, settings.record);
  std::vector<std::unique_ptr<Measure>> measures = all_measures(scenario.measures);
  std::vector<scenarios::Observer*> observers = settings.observers;
  for (const auto& measure : measures) {
    measure->begin(*trial.world);
    if (measure->every_s() > 0.0) observers.push_back(measure.get());
  }
  if (settings.record && scenario.trial.record_every_s > 0.0) {
    trial.record = std::make_unique<scenarios::TrialRecord>(scenario.trial.record_every_s);
    observers.push_back(trial.record.get());
  }

  for (std::size_t i = 0; i < trial.world->size(); ++i) {
    if (settings.plan_observer) trial.world->observe_planner(i, settings.plan_observer(i));
    for (const auto& measure : measures) {
      if (auto* observer = measure->plan_observer(i)) trial.world->observe_planner(i, *observer);
    }
  }

  const auto began = std::chrono::steady_clock::now();
  trial.world->run(observers);
  trial.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();

  for (const auto& measure : measures) conclude(*measure, *trial.world, trial.results);
  return trial;
}

}  // namespace shoal::analysis
