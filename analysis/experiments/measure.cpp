#include "shoal/analysis/experiments/measure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <stdexcept>

#include "shoal/core/text.hpp"

namespace shoal::analysis {

std::optional<double> Results::at(std::string_view name) const {
  for (const auto& [known, value] : values) {
    if (known == name) return value;
  }
  throw std::out_of_range("no measure is called " + std::string(name));
}

const scenarios::Series& Results::earlier_series(std::string_view name) const {
  const auto found = std::ranges::find(series, name, &scenarios::Series::name);
  if (found == series.end()) {
    throw std::logic_error("no earlier measure added the series " + std::string(name));
  }
  return *found;
}

double Measure::log_interval_s(const scenarios::World& world) {
  const double tick = world.scenario().trial.tick_s;
  return tick * std::max(1.0, std::round(5.0 / tick));
}

double Measure::series_interval_s(const scenarios::World& world) {
  const double every_s = world.scenario().quality.every_s;
  return every_s > 0.0 ? every_s : 6.0 * log_interval_s(world);
}

bool SeriesGrid::due(double time_s) {
  // Times are whole ticks: half a millisecond is less than any.
  constexpr double rounding_s = 5e-4;
  const double next_s = every_s_ * static_cast<double>(time_s_.size());
  if (time_s < next_s - rounding_s) return false;
  time_s_.push_back(time_s);
  return true;
}

namespace {

[[noreturn]] void undeclared(const std::string& name) {
  throw std::logic_error("a measure must yield what it declares, in that order; see " + name);
}

bool finite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

std::vector<Quantity> gathered(std::vector<Quantity> (Measure::*list)() const) {
  std::vector<Quantity> all;
  const auto& registry = Registry<Measure>::instance();
  for (const MemberInfo& member : registry.members()) {
    const auto measure = registry.make(member.name, Setting{}, member.name);
    for (Quantity& quantity : ((*measure).*list)()) all.push_back(std::move(quantity));
  }
  return all;
}

/// What measures yield, gathered anew when there are others; earlier answers stay where they are.
class Known {
 public:
  const std::vector<Quantity>& of(std::vector<Quantity> (Measure::*list)() const) {
    const std::lock_guard lock(mutex_);
    const std::size_t generation = Registry<Measure>::instance().generation();
    const auto found = by_generation_.find(generation);
    if (found != by_generation_.end()) return found->second;
    return by_generation_.emplace(generation, gathered(list)).first->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::size_t, std::vector<Quantity>> by_generation_;
};

const Quantity& named(const std::vector<Quantity>& known, const std::string& name,
                      const std::string& what, const Origin& origin) {
  std::vector<std::string> names;
  for (const Quantity& quantity : known) {
    if (quantity.name == name) return quantity;
    names.push_back(quantity.name);
  }
  throw InputError(origin,
                   "no measure yields a " + what + " \"" + name + '"' + suggestion(name, names));
}

}  // namespace

void conclude(const Measure& measure, const scenarios::World& world, Results& results) {
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
    if (added.time_s.size() != added.values.size() || !finite(added.values)) {
      throw std::logic_error("the series " + added.name +
                             " needs a finite number at every instant");
    }
    added.unit = series[i].unit;
    added.meaning = series[i].meaning;
  }
}

const std::vector<Quantity>& known_values() {
  static Known known;
  return known.of(&Measure::values);
}

const std::vector<Quantity>& known_series() {
  static Known known;
  return known.of(&Measure::series);
}

const Quantity& known_value(const std::string& name, const Origin& origin) {
  return named(known_values(), name, "value", origin);
}

const Quantity& known_series(const std::string& name, const Origin& origin) {
  return named(known_series(), name, "series", origin);
}

void survivors(const scenarios::World& world, std::vector<Eigen::Vector2d>& positions,
               std::vector<int>& slots) {
  positions.clear();
  slots.clear();
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (world.lost(i)) continue;
    positions.emplace_back(world.swarm().x_m[i], world.swarm().y_m[i]);
    slots.push_back(static_cast<int>(i));
  }
}

Eigen::Vector2d mean_of(const std::vector<Eigen::Vector2d>& points) {
  const Eigen::Vector2d sum =
      std::accumulate(points.begin(), points.end(), Eigen::Vector2d::Zero().eval());
  return sum / static_cast<double>(points.size());
}

}  // namespace shoal::analysis
