#include <memory>

#include "shoal/analysis/measure.hpp"
#include "shoal/analysis/measures/formation_quality.hpp"

namespace shoal::analysis {
namespace {

// The assignment takes time that grows with the third power of the number of vehicles.
constexpr std::size_t most_vehicles = 500;
constexpr double good_m = 20.0;
constexpr double settled_from = 0.4;  // share of the mission: its last 60 % are "settled"

/// The formation quality against time (Rypkema 2015, sec. 4.3), with the plan padded by layers of
/// lattice positions. Vehicles that are lost no longer count.
class Quality final : public Measure {
 public:
  static void declare(Options<Quality>&) {}

  void begin(const scenarios::World& world) override {
    const scenarios::QualityOptions& options = world.scenario().quality;
    every_s_ = options.every_s;
    if (every_s_ <= 0.0) return;
    if (world.size() > most_vehicles) {
      throw InputError(world.scenario().plan.setting().origin,
                       "the formation quality of " + std::to_string(world.size()) +
                           " vehicles would take longer than the trial (it is meant for up to " +
                           std::to_string(most_vehicles) + "); set quality.every_s = 0");
    }
    metric_ = std::make_shared<FormationQuality>(
        world.scenario().plan.make()->padded(static_cast<int>(options.layers)), options.alignment,
        options.delta_theta_deg);
  }

  void observe(const scenarios::World& world) override {
    survivors(world, positions_, slots_);
    if (positions_.empty()) return;
    time_s_.push_back(world.time_s());
    quality_m_.push_back(metric_->of(positions_));
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::optional<double> final_m, settled_m, reached_s;
    double sum = 0.0;
    int settled = 0;
    for (std::size_t k = 0; k < time_s_.size(); ++k) {
      final_m = quality_m_[k];
      if (!reached_s && quality_m_[k] < good_m) reached_s = time_s_[k];
      if (time_s_[k] < settled_from * world.time_s()) continue;
      sum += quality_m_[k];
      ++settled;
    }
    if (settled > 0) settled_m = sum / settled;
    results.add("quality_final_m", final_m);
    results.add("quality_settled_m", settled_m);
    results.add("time_to_quality_20m_s", reached_s);
    if (every_s_ > 0.0) {
      results.series.push_back(
          {"quality", "m", "formation quality (Rypkema 2015, sec. 4.3)", time_s_, quality_m_});
    }
  }

 private:
  std::shared_ptr<FormationQuality> metric_;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> slots_;
  std::vector<double> time_s_, quality_m_;
};

const Enrol<Measure, Quality> enrolled{
    "quality", "quality_{final,settled}_m (last 60 % of the mission), time_to_quality_20m_s"};

}  // namespace
}  // namespace shoal::analysis
