#include "shoal/analysis/experiments/measures/slot_keeping.hpp"

#include <algorithm>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/held_slots.hpp"
#include "shoal/analysis/experiments/measures/lattice_occupation.hpp"
#include "shoal/analysis/experiments/measures/quality_history.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::analysis {

SlotKeeping::SlotKeeping(std::span<const Eigen::Vector2d> slots,
                         std::span<const Eigen::Vector2f> places)
    : vehicles_(slots.size()) {
  for (std::size_t k = 0; k + vehicles_ <= places.size(); k += vehicles_) {
    solvers::Procrustes registration;
    for (std::size_t i = 0; i < vehicles_; ++i) {
      registration.add(slots[i], places[k + i].cast<double>(), 1.0);
    }
    const Transform2 T_world_plan = registration.solve().T_to_from;
    for (std::size_t i = 0; i < vehicles_; ++i) {
      off_m_.push_back((T_world_plan * slots[i] - places[k + i].cast<double>()).norm());
    }
  }
}

double SlotKeeping::mean_m(std::size_t instant) const {
  const auto first = off_m_.begin() + static_cast<std::ptrdiff_t>(instant * vehicles_);
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(vehicles_), 0.0) /
         static_cast<double>(vehicles_);
}

std::vector<std::size_t> SlotKeeping::elsewhere(std::size_t instant, double spacing_m) const {
  std::vector<std::size_t> vehicles;
  for (std::size_t i = 0; i < vehicles_; ++i) {
    if (off_m(instant, i) >= 0.5 * spacing_m) vehicles.push_back(i);
  }
  return vehicles;
}

namespace {

/// The formation quality at full sampling, 5 s, and vehicles that change their slots (Rypkema 2015,
/// sec. 5.1.2, 5.3.2, 5.5).
///
/// A search for the best slots at every 5 s would cost more than the trial; the slots are those of
/// the end of the mission instead, and vehicles that are lost count at no time. Only where the
/// quality is measured.
class SlotKeepingMeasure final : public Measure {
 public:
  double left_spacings = 0.8, arrived_spacings = 0.2;

  static void declare(Options<SlotKeepingMeasure>& o) {
    using S = SlotKeepingMeasure;
    o.number("left_spacings", &S::left_spacings, "", above(0),
             "a vehicle is between two slots where it is nearer than this many separations to the "
             "one that it comes to, and farther than arrived_spacings");
    o.number("arrived_spacings", &S::arrived_spacings, "", at_least(0),
             "a vehicle this many separations from the slot that it comes to, or less, is there");
  }
  std::optional<std::string> complaint() const {
    if (arrived_spacings < left_spacings) return std::nullopt;
    return "arrived_spacings must be below left_spacings";
  }

  std::vector<Quantity> values() const override {
    return {
        {"quality_wave_m", "m",
         "rms about its mean over 10 minutes of the formed swarm's quality, every 5 s, with the "
         "slots held at the end"},
        {"slot_changes", "", "vehicles that change their slots in the last 60 % of the mission"},
        {"quality_in_transit_m", "m", "mean quality then, while one of them is between slots"},
        {"quality_in_place_m", "m", "mean quality then, while none of them is"}};
  }

  void begin(const scenarios::World& world) override {
    if (world.scenario().quality.every_s > 0.0) every_s_ = log_interval_s(world);
  }

  void observe(const scenarios::World& world) override {
    time_s_.push_back(world.time_s());
    for (std::size_t i = 0; i < world.size(); ++i) {
      places_.emplace_back(static_cast<float>(world.swarm().x_m[i]),
                           static_cast<float>(world.swarm().y_m[i]));
    }
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::vector<Eigen::Vector2d> last;
    std::vector<int> vehicles;
    survivors(world, last, vehicles);
    if (time_s_.empty() || last.size() < 2) {
      for (const Quantity& quantity : values()) results.add(quantity.name, std::nullopt);
      return;
    }
    const SlotKeeping keeping(held_slots(world, last).positions(),
                              places_of(vehicles, world.size()));
    std::vector<double> mean_m;
    for (std::size_t k = 0; k < time_s_.size(); ++k) mean_m.push_back(keeping.mean_m(k));
    results.add("quality_wave_m", QualityHistory(time_s_, mean_m, world.time_s()).oscillation_m());

    const double spacing_m = least_spacing_m(world.plan().slots());
    const std::size_t settled = at(settled_from * world.time_s());
    const std::vector<std::size_t> movers = keeping.elsewhere(settled, spacing_m);
    results.add("slot_changes", static_cast<double>(movers.size()));
    Mean transit, place;
    const scenarios::Series& quality = results.earlier_series("quality");
    for (std::size_t k = 0; k < quality.time_s.size(); ++k) {
      if (quality.time_s[k] < time_s_[settled]) continue;
      const std::size_t instant = at(quality.time_s[k]);
      const bool under_way = std::ranges::any_of(movers, [&](std::size_t i) {
        const double off = keeping.off_m(instant, i) / spacing_m;
        return off > arrived_spacings && off < left_spacings;
      });
      (under_way ? transit : place).add(quality.values[k]);
    }
    results.add("quality_in_transit_m", transit.value());
    results.add("quality_in_place_m", place.value());
  }

 private:
  struct Mean {
    double sum = 0.0;
    int count = 0;
    void add(double x) {
      sum += x;
      ++count;
    }
    std::optional<double> value() const {
      return count > 0 ? std::optional(sum / count) : std::nullopt;
    }
  };

  /// The last look that is not after a time.
  std::size_t at(double time_s) const {
    constexpr double rounding_s = 5e-4;  // less than any tick
    const auto after = std::ranges::upper_bound(time_s_, time_s + rounding_s);
    return static_cast<std::size_t>(std::max(after - time_s_.begin(), std::ptrdiff_t{1}) - 1);
  }

  std::vector<Eigen::Vector2f> places_of(std::span<const int> vehicles, std::size_t all) const {
    std::vector<Eigen::Vector2f> places;
    for (std::size_t k = 0; k < time_s_.size(); ++k) {
      for (const int i : vehicles) places.push_back(places_[k * all + static_cast<std::size_t>(i)]);
    }
    return places;
  }

  std::vector<double> time_s_;
  std::vector<Eigen::Vector2f> places_;  // instants x vehicles
};

const Register<Measure, SlotKeepingMeasure> registered{
    "slot_keeping", "the quality at full sampling, and vehicles that change their slots"};

}  // namespace
}  // namespace shoal::analysis
