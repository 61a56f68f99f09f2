#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

/// Energy per vehicle since mission start (Rypkema 2015, sec. 4.1.1), over the vehicles that are
/// left at the end.
class EnergyMeasure final : public Measure {
 public:
  static void declare(Options<EnergyMeasure>&) {}

  void finish(const scenarios::World& w, Results& results) const override {
    const auto total = over_survivors(
        w, [&](std::size_t i) { return w.propulsion_wh(i) + w.hotel_wh(i) + w.comms_wh(i); });
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
  }
};

const Enrol<Measure, EnergyMeasure> enrolled{
    "energy", "energy_{mean,min,max}_wh, energy_{propulsion,hotel,comms}_mean_wh per vehicle"};

}  // namespace
}  // namespace shoal::analysis
