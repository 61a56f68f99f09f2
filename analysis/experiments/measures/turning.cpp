#include <array>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/tracks.hpp"
#include "shoal/core/angles.hpp"

namespace shoal::analysis {
namespace {

/// How jagged tracks are (Rypkema 2015, sec. 5.2.1, 5.3.1): by how much they turn from one step of
/// 10 m and more to the next, over all steps of all vehicles, and apart for water that moves the
/// vehicles and water that hardly does. A straight track turns by 0, one that goes to and fro by
/// 180 degrees.
class Turning final : public Measure {
 public:
  double still_water_m_s = 0.02;  // a fifth of the weakest current of his scenarios

  static void declare(Options<Turning>& o) {
    o.number("still_water_m_s", &Turning::still_water_m_s, "m/s", at_least(0),
             "water that moves more slowly is taken to be still");
  }

  std::vector<Quantity> values() const override {
    return {{"turning_deg", "deg", "turn of the tracks between steps of 10 m, mean"},
            {"turning_in_current_deg", "deg",
             "the same, where the water moves by measure.turning.still_water_m_s or more"},
            {"turning_in_still_water_deg", "deg", "the same, where it moves less"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = log_interval_s(world); }

  void observe(const scenarios::World& world) override {
    log_.look(world, [&](std::size_t i) {
      const Track& track = log_.tracks()[i];
      if (track.size() < 3) return;
      const std::size_t last = track.size() - 1;
      Sum& sum = sums_[world.current_m_s(i).norm() < still_water_m_s ? 0 : 1];
      sum.turns += turn(track[last - 2], track[last - 1], track[last]);
      ++sum.count;
    });
  }

  void finish(const scenarios::World&, Results& results) const override {
    const auto& [still, moving] = sums_;
    results.add("turning_deg", Sum{still.turns + moving.turns, still.count + moving.count}.mean());
    results.add("turning_in_current_deg", moving.mean());
    results.add("turning_in_still_water_deg", still.mean());
  }

 private:
  struct Sum {
    double turns = 0.0;
    int count = 0;
    std::optional<double> mean() const {
      return count > 0 ? std::optional(degrees(turns / count)) : std::nullopt;
    }
  };

  TrackLog log_{path_step_m};
  std::array<Sum, 2> sums_;
};

const Register<Measure, Turning> registered{"turning", "how jagged the tracks are"};

}  // namespace
}  // namespace shoal::analysis
