#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shoal/core/registry.hpp"
#include "shoal/scenarios/series.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::analysis {

/// A number that measures yield: its name ends with its unit.
struct Quantity {
  std::string name;
  std::string unit;  ///< "" for a pure number
  std::string meaning;
  /// Of the time to an event that a trial may never see: the value that says how long the trial was
  /// watched for it. Where that has a value and the time has none, the event did not come by then;
  /// where neither has, there was nothing to wait for.
  std::string censored_by = {};
  /// Of what is taken when an event comes, or at the end if it never does: the value that holds the
  /// time to that event.
  std::string event = {};
};

/// What the measures of one trial say. Names carry their units; a measure without a value (never
/// reached, not defined for this trial) is null.
struct Results {
  std::vector<std::pair<std::string, std::optional<double>>> values;
  std::vector<scenarios::Series> series;

  void add(std::string name, std::optional<double> value) {
    values.emplace_back(std::move(name), value);
  }
  /// Numbers against time; unit and meaning are those that the measure declares.
  void add_series(std::string name, std::vector<double> time_s, std::vector<double> numbers) {
    series.push_back({std::move(name), "", "", std::move(time_s), std::move(numbers)});
  }
  /// Throws std::out_of_range if no measure has that name.
  std::optional<double> at(std::string_view name) const;
  /// Numbers against time that an earlier measure added. Throws std::logic_error if none did.
  const scenarios::Series& earlier_series(std::string_view name) const;
};

/// Measures something of a trial. One file each; registered ones are part of every trial.
class Measure : public scenarios::Observer {
 public:
  static constexpr const char* family = "measure";
  static constexpr const char* family_meaning = "says how well a trial went";

  /// What finish() adds, each time and in this order: values, and series against time. An instant
  /// at which a number is not defined is left out of its series.
  virtual std::vector<Quantity> values() const = 0;
  virtual std::vector<Quantity> series() const { return {}; }

  /// Called once before the trial runs. Throws InputError if the scenario asks too much.
  virtual void begin(const scenarios::World& world) { (void)world; }

  /// What sees the plans of a vehicle, if the measure goes by them. After begin(); of several
  /// vehicles at a time, on several threads.
  virtual formations::PlanObserver* plan_observer(std::size_t vehicle) {
    (void)vehicle;
    return nullptr;
  }

  /// Seconds between two looks, 0 for none. Measures look every 5 s, as the author's log did,
  /// unless they say otherwise.
  double every_s() const override { return every_s_; }
  void observe(const scenarios::World& world) override { (void)world; }

  /// Called once when the trial has ended, in the order of the measures' names: `results` holds
  /// what earlier ones said.
  virtual void finish(const scenarios::World& world, Results& results) const = 0;

 protected:
  /// The multiple of the tick nearest to 5 s.
  static double log_interval_s(const scenarios::World& world);
  /// The instants of all series: quality.every_s, or about 30 s where the quality is not measured.
  static double series_interval_s(const scenarios::World& world);

  double every_s_ = 0.0;
};

/// Adds what a measure says, with the units and meanings that it declares. Throws std::logic_error
/// if that is not what it declares, or is not finite.
void conclude(const Measure& measure, const scenarios::World& world, Results& results);

/// All values and all series that measures yield, in the order of their measures.
const std::vector<Quantity>& known_values();
const std::vector<Quantity>& known_series();
/// Throws InputError (at `origin`), with the likely name, if no measure yields it.
const Quantity& known_value(const std::string& name, const Origin& origin = {});
const Quantity& known_series(const std::string& name, const Origin& origin = {});

/// Where "settled" begins: the last 60 % of the mission.
inline constexpr double settled_from = 0.4;

/// Numbers at regular instants, gathered by a measure that may look more often.
class SeriesGrid {
 public:
  void begin(double every_s) { every_s_ = every_s; }
  /// Whether an instant of the grid has come; then `time_s` is one of it.
  bool due(double time_s);
  const std::vector<double>& time_s() const { return time_s_; }

 private:
  double every_s_ = 0.0;
  std::vector<double> time_s_;
};

/// Mean, least and greatest of a number over the vehicles that are left.
struct Spread {
  double mean = 0.0, least = 0.0, greatest = 0.0;
};
template <class Value>
std::optional<Spread> over_survivors(const scenarios::World& world, Value value) {
  Spread spread;
  int count = 0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (world.lost(i)) continue;
    const double x = value(i);
    spread.mean += x;
    spread.least = count == 0 || x < spread.least ? x : spread.least;
    spread.greatest = count == 0 || x > spread.greatest ? x : spread.greatest;
    ++count;
  }
  if (count == 0) return std::nullopt;
  spread.mean /= count;
  return spread;
}

/// Positions (m) of the vehicles that are left, and their slots.
void survivors(const scenarios::World& world, std::vector<Eigen::Vector2d>& positions,
               std::vector<int>& slots);

Eigen::Vector2d mean_of(const std::vector<Eigen::Vector2d>& points);

}  // namespace shoal::analysis
