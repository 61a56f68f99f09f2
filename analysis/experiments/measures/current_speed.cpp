#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// How fast the water moves the vehicles, and beside the speed at which they thrust (Rypkema 2015,
/// sec. 5.4): at the places of the vehicles that are left.
class CurrentSpeed final : public Measure {
 public:
  static void declare(Options<CurrentSpeed>&) {}

  std::vector<Quantity> values() const override {
    return {{"current_speed_mean_m_s", "m/s", "speed of the water at the vehicles, mean"},
            {"current_speed_ratio", "", "the same / the speed asked for when thrusting"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = series_interval_s(world); }

  void observe(const scenarios::World& world) override {
    if (world.time_s() <= 0.0) return;
    const auto speed =
        over_survivors(world, [&](std::size_t i) { return world.current_m_s(i).norm(); });
    if (!speed) return;
    sum_ += speed->mean;
    ++count_;
  }

  void finish(const scenarios::World& world, Results& results) const override {
    const auto mean = count_ > 0 ? std::optional(sum_ / count_) : std::nullopt;
    results.add("current_speed_mean_m_s", mean);
    results.add("current_speed_ratio",
                mean ? std::optional(*mean / world.guidance().highest_speed_m_s()) : std::nullopt);
  }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

const Register<Measure, CurrentSpeed> registered{"current_speed",
                                                 "how fast the water moves the vehicles"};

}  // namespace
}  // namespace shoal::analysis
