#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

/// Shares of time and of distance spent thrusting (Rypkema 2015, sec. 5.4). The time ratio counts
/// time under a command to move; the distance ratio is mean thrusting distance / mean distance,
/// with the glide after a thrust counted as thrusting, as in the author's log.
class Thrust final : public Measure {
 public:
  static void declare(Options<Thrust>&) {}

  void finish(const scenarios::World& w, Results& results) const override {
    const auto time =
        over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrusting_s / w.time_s(); });
    const auto distance = over_survivors(w, [&](std::size_t i) { return w.logbook(i).distance_m; });
    const auto thrust_distance =
        over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrust_distance_m; });
    results.add("thrust_time_ratio_mean", time ? std::optional(time->mean) : std::nullopt);
    results.add("thrust_time_ratio_min", time ? std::optional(time->least) : std::nullopt);
    results.add("thrust_time_ratio_max", time ? std::optional(time->greatest) : std::nullopt);
    results.add("thrust_distance_ratio_mean",
                distance && distance->mean > 0.0
                    ? std::optional(thrust_distance->mean / distance->mean)
                    : std::nullopt);
  }
};

const Enrol<Measure, Thrust> enrolled{
    "thrust", "thrust_time_ratio_{mean,min,max}, thrust_distance_ratio_mean"};

}  // namespace
}  // namespace shoal::analysis
