#include <optional>
#include <vector>

#include "shoal/analysis/measure.hpp"
#include "shoal/analysis/measures/circular_spread.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/formations/lattice_symmetry.hpp"

namespace shoal::analysis {
namespace {

constexpr double hour_s = 3600.0;

/// How much vehicles disagree on how the plan is turned: the circular standard deviation of the
/// rotation of the plan that each last laid onto its neighbours. Rotations that map the lattice
/// onto itself count as the same. No value for behaviours that lay no plan.
class Disagreement final : public Measure {
 public:
  static void declare(Options<Disagreement>&) {}

  std::vector<Quantity> values() const override {
    return {{"rotation_disagreement_deg", "deg",
             "spread of the vehicles' rotations of the plan, mean of the last 60 % of the mission"},
            {"rotation_disagreement_first_hour_deg", "deg", "the same, mean of the first hour"}};
  }

  std::vector<Quantity> series() const override {
    return {{"rotation_disagreement_deg", "deg", "spread of the vehicles' rotations of the plan"}};
  }

  void begin(const scenarios::World& world) override {
    every_s_ = series_interval_s(world);
    order_ = formations::lattice_symmetry(world.plan());
  }

  void observe(const scenarios::World& world) override {
    angles_.clear();
    for (std::size_t i = 0; i < world.size(); ++i) {
      const auto& T_own_plan = world.planner(i).last_target().T_own_plan;
      if (!world.lost(i) && T_own_plan) angles_.push_back(T_own_plan->angle());
    }
    const std::optional<double> spread = circular_spread(angles_, order_);
    if (!spread) return;
    time_s_.push_back(world.time_s());
    spread_deg_.push_back(degrees(*spread));
  }

  void finish(const scenarios::World& world, Results& results) const override {
    results.add("rotation_disagreement_deg",
                mean_between(settled_from * world.time_s(), world.time_s()));
    results.add("rotation_disagreement_first_hour_deg", mean_between(0.0, hour_s));
    results.add_series("rotation_disagreement_deg", time_s_, spread_deg_);
  }

 private:
  std::optional<double> mean_between(double from_s, double to_s) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < time_s_.size(); ++k) {
      if (time_s_[k] < from_s || time_s_[k] > to_s) continue;
      sum += spread_deg_[k];
      ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  }

  int order_ = 1;
  std::vector<double> angles_;  // rad, axes of the world
  std::vector<double> time_s_, spread_deg_;
};

const Enrol<Measure, Disagreement> enrolled{
    "disagreement", "how much vehicles disagree on the rotation of the plan"};

}  // namespace
}  // namespace shoal::analysis
