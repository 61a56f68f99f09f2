#include <algorithm>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

constexpr double longest_window_s = 300.0;  // vehicles forget a lost one within 120 s

/// Do vehicles spend more when one of them is lost (Rypkema 2015, sec. 5.2.3)? What those that are
/// left spend in a window after each loss, as a share of what the same ones spent in the window
/// before; windows of 300 s, or of the time between two losses if that is less.
class LossPower final : public Measure {
 public:
  static void declare(Options<LossPower>&) {}

  std::vector<Quantity> values() const override {
    return {{"loss_power_ratio", "",
             "energy in the 300 s after each loss / in the 300 s before, of the vehicles left"}};
  }

  void begin(const scenarios::World& world) override {
    const scenarios::Fault& loss = world.fault();
    if (loss.count() == 0) return;
    every_s_ = log_interval_s(world);
    window_s_ = std::min(longest_window_s, loss.every_s());
    for (std::int64_t k = 1; k <= loss.count(); ++k) {
      const double lost_s = static_cast<double>(k) * loss.every_s();
      for (const double at_s : {lost_s - window_s_, lost_s, lost_s + window_s_}) {
        snapshots_.push_back({at_s, {}});
      }
    }
  }

  void observe(const scenarios::World& world) override {
    for (Snapshot& snapshot : snapshots_) {
      if (!snapshot.energy_wh.empty() || world.time_s() < snapshot.at_s) continue;
      for (std::size_t i = 0; i < world.size(); ++i) {
        const double energy_wh = world.propulsion_wh(i) + world.hotel_wh(i) + world.comms_wh(i);
        snapshot.energy_wh.push_back(world.lost(i) ? -1.0 : energy_wh);
      }
    }
  }

  void finish(const scenarios::World&, Results& results) const override {
    double before_wh = 0.0, after_wh = 0.0;
    for (std::size_t k = 0; k + 2 < snapshots_.size(); k += 3) {
      const std::vector<double>& last = snapshots_[k + 2].energy_wh;
      for (std::size_t i = 0; i < last.size(); ++i) {
        if (last[i] < 0.0) continue;
        before_wh += snapshots_[k + 1].energy_wh[i] - snapshots_[k].energy_wh[i];
        after_wh += last[i] - snapshots_[k + 1].energy_wh[i];
      }
    }
    results.add("loss_power_ratio",
                before_wh > 0.0 ? std::optional(after_wh / before_wh) : std::nullopt);
  }

 private:
  struct Snapshot {
    double at_s;
    std::vector<double> energy_wh;  // of each vehicle, -1 if it is lost; empty until then
  };

  double window_s_ = 0.0;
  std::vector<Snapshot> snapshots_;  // of each loss: before, at, after
};

const Register<Measure, LossPower> registered{"loss_power",
                                              "do vehicles spend more when one of them is lost"};

}  // namespace
}  // namespace shoal::analysis
