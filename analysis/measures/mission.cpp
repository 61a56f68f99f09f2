#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

constexpr double days_per_s = 1.0 / 86400.0;

/// How long the mission lasted, and how long it could last at the power spent so far.
///
/// The estimate is the author's ESTIMATION_DURATION_DAYS (uSimConsumption; Rypkema 2015, sec. 4.1
/// and 4.1.1): energy pack x mission time / energy spent. It extrapolates the whole mission, with
/// the effort of forming.
class Mission final : public Measure {
 public:
  static void declare(Options<Mission>&) {}

  std::vector<Quantity> values() const override {
    return {{"mission_s", "s", "length of the mission, as it was ended"},
            {"stop_watched_s", "s", "how long the stop rule had to end the trial, if there is one"},
            {"stopped_s", "s", "when the stop rule ended the trial", "stop_watched_s"},
            {"mission_estimate_days", "d",
             "how long the battery would last at the mean power so far, mean of vehicles"},
            {"mission_estimate_min_days", "d", "the same of the vehicle that spent most"}};
  }

  void finish(const scenarios::World& w, Results& results) const override {
    const auto days = over_survivors(w, [&](std::size_t i) {
      const double spent_wh = w.propulsion_wh(i) + w.hotel_wh(i) + w.comms_wh(i);
      if (!(spent_wh > 0.0)) return 0.0;  // it would last for ever
      return w.scenario().energy.battery_wh * w.time_s() * days_per_s / spent_wh;
    });
    const bool all_spent = days && days->least > 0.0;
    results.add("mission_s", w.time_s());
    const std::string& rule = w.scenario().stop.kind();
    const auto mission_if = [&](bool held) {
      return held ? std::optional(w.time_s()) : std::nullopt;
    };
    results.add("stop_watched_s", mission_if(rule != "duration"));
    results.add("stopped_s", mission_if(rule != "duration" && w.stopped_by() == rule));
    results.add("mission_estimate_days", all_spent ? std::optional(days->mean) : std::nullopt);
    results.add("mission_estimate_min_days", all_spent ? std::optional(days->least) : std::nullopt);
  }
};

const Enrol<Measure, Mission> enrolled{"mission", "how long the mission lasted, and could last"};

}  // namespace
}  // namespace shoal::analysis
