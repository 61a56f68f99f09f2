#include <algorithm>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

constexpr double joules_per_wh = 3600.0;

/// Energy per vehicle since mission start (Rypkema 2015, sec. 4.1.1), over the vehicles that are
/// left. The endurance is the program's estimate of the mission's length (sec. 4.1 and 4.1.1:
/// energy pack x time / energy spent).
class EnergyMeasure final : public Measure {
 public:
  static void declare(Options<EnergyMeasure>&) {}

  std::vector<Quantity> values() const override {
    return {{"energy_mean_wh", "Wh", "energy spent, mean over vehicles"},
            {"energy_min_wh", "Wh", "energy of the vehicle that spent least"},
            {"energy_max_wh", "Wh", "energy of the vehicle that spent most"},
            {"energy_propulsion_mean_wh", "Wh", "energy for propulsion, mean over vehicles"},
            {"energy_hotel_mean_wh", "Wh", "energy for the hotel load, mean over vehicles"},
            {"energy_comms_mean_wh", "Wh", "energy for pings, mean over vehicles"},
            {"energy_spread_wh", "Wh", "energy_max_wh - energy_min_wh"},
            {"energy_rate_w", "W", "mean power in the last 60 % of the mission"},
            {"endurance_mean_h", "h",
             "how long a battery lasts at the mean power that vehicles drew until it was empty"},
            {"endurance_min_h", "h",
             "the same at the power of the vehicle that drew most: when the first one stops"},
            {"empty_vehicles", "", "vehicles whose battery became empty"},
            {"empty_first_s", "s", "when the first battery was empty"},
            {"empty_last_s", "s", "when the last of those that became empty was"}};
  }

  std::vector<Quantity> series() const override {
    return {{"energy_mean_wh", "Wh", "energy spent, mean over vehicles left"},
            {"energy_min_wh", "Wh", "energy of the vehicle that spent least"},
            {"energy_max_wh", "Wh", "energy of the vehicle that spent most"},
            {"empty_vehicles", "", "vehicles whose battery is empty"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = series_interval_s(world); }

  void observe(const scenarios::World& world) override {
    const auto total = over_survivors(world, [&](std::size_t i) { return energy_wh(world, i); });
    if (!total) return;
    time_s_.push_back(world.time_s());
    mean_wh_.push_back(total->mean);
    min_wh_.push_back(total->least);
    max_wh_.push_back(total->greatest);
    empty_.push_back(static_cast<double>(empty_times_s(world).size()));
    for (std::size_t i = 0; i < world.size(); ++i) spent_wh_.push_back(energy_wh(world, i));
  }

  void finish(const scenarios::World& w, Results& results) const override {
    const auto total = over_survivors(w, [&](std::size_t i) { return energy_wh(w, i); });
    const auto mean = [&](auto value) -> std::optional<double> {
      const auto spread = over_survivors(w, value);
      return spread ? std::optional(spread->mean) : std::nullopt;
    };
    results.add("energy_mean_wh", total ? std::optional(total->mean) : std::nullopt);
    results.add("energy_min_wh", total ? std::optional(total->least) : std::nullopt);
    results.add("energy_max_wh", total ? std::optional(total->greatest) : std::nullopt);
    results.add("energy_propulsion_mean_wh",
                mean([&](std::size_t i) { return w.propulsion_wh(i); }));
    results.add("energy_hotel_mean_wh", mean([&](std::size_t i) { return w.hotel_wh(i); }));
    results.add("energy_comms_mean_wh", mean([&](std::size_t i) { return w.comms_wh(i); }));
    results.add("energy_spread_wh",
                total ? std::optional(total->greatest - total->least) : std::nullopt);
    results.add("energy_rate_w", settled_rate_w(w));
    const auto power = over_survivors(w, [&](std::size_t i) {
      const double lasted_s = w.stopped(i) ? w.empty_s(i) : w.time_s();
      return energy_wh(w, i) * joules_per_wh / lasted_s;
    });
    const auto endurance_h = [&](double power_w) -> std::optional<double> {
      return power_w > 0.0 ? std::optional(w.scenario().energy.battery_wh / power_w) : std::nullopt;
    };
    results.add("endurance_mean_h", power ? endurance_h(power->mean) : std::nullopt);
    results.add("endurance_min_h", power ? endurance_h(power->greatest) : std::nullopt);
    const std::vector<double> empty_s = empty_times_s(w);
    results.add("empty_vehicles", static_cast<double>(empty_s.size()));
    results.add("empty_first_s",
                empty_s.empty() ? std::nullopt : std::optional(std::ranges::min(empty_s)));
    results.add("empty_last_s",
                empty_s.empty() ? std::nullopt : std::optional(std::ranges::max(empty_s)));
    results.add_series("energy_mean_wh", time_s_, mean_wh_);
    results.add_series("energy_min_wh", time_s_, min_wh_);
    results.add_series("energy_max_wh", time_s_, max_wh_);
    results.add_series("empty_vehicles", time_s_, empty_);
  }

 private:
  static std::vector<double> empty_times_s(const scenarios::World& w) {
    std::vector<double> times;
    for (std::size_t i = 0; i < w.size(); ++i) {
      if (w.empty_s(i) >= 0.0) times.push_back(w.empty_s(i));
    }
    return times;
  }

  static double energy_wh(const scenarios::World& w, std::size_t i) {
    return w.propulsion_wh(i) + w.hotel_wh(i) + w.comms_wh(i);
  }

  // Of the same vehicles at both ends, so that losses are no change of power. When the mission ends
  // is not known before it does: arrival or a stop rule may end it.
  std::optional<double> settled_rate_w(const scenarios::World& w) const {
    const auto from = std::ranges::lower_bound(time_s_, settled_from * w.time_s());
    if (from == time_s_.end() || *from >= w.time_s()) return std::nullopt;
    const double lasted_s = w.time_s() - *from;
    const std::size_t before = static_cast<std::size_t>(from - time_s_.begin()) * w.size();
    const auto spent =
        over_survivors(w, [&](std::size_t i) { return energy_wh(w, i) - spent_wh_[before + i]; });
    if (!spent) return std::nullopt;
    return spent->mean * joules_per_wh / lasted_s;
  }

  std::vector<double> time_s_, mean_wh_, min_wh_, max_wh_, empty_;
  std::vector<double> spent_wh_;  // of every vehicle at every look
};

const Register<Measure, EnergyMeasure> registered{"energy",
                                                  "energy spent by the vehicles that are left"};

}  // namespace
}  // namespace shoal::analysis
