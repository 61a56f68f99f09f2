#include <optional>
#include <vector>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/circular_spread.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/formations/lattice_symmetry.hpp"

namespace shoal::analysis {
namespace {

constexpr double hour_s = 3600.0;
/// The end of a mission: its last tenth.
constexpr double end_from = 0.9;

/// Vehicles agree where the spread of their rotations is below this (degrees). Two of such standard
/// deviations reach half-way to the rotation most unlike the common one, which is half the angle
/// away by which the lattice repeats: 11.25 degrees for a square lattice, 7.5 for a hexagonal one.
constexpr double agreement_below_deg(int order) {
  return 360.0 / order / 8.0;
}

/// How much vehicles disagree on how the plan is turned: the circular standard deviation of the
/// rotation of the plan that each last laid onto its neighbours. Rotations that map the lattice
/// onto itself count as the same. No value for behaviours that lay no plan.
///
/// Trials in which vehicles agree and those in which they do not are of two kinds; a mean of both
/// describes neither, so that their energies are told apart, too.
class Disagreement final : public Measure {
 public:
  static void declare(Options<Disagreement>&) {}

  std::vector<Quantity> values() const override {
    return {{"rotation_disagreement_deg", "deg",
             "spread of the vehicles' rotations of the plan, mean of the last 60 % of the mission"},
            {"rotation_disagreement_first_hour_deg", "deg", "the same, mean of the first hour"},
            {"rotation_disagreement_end_deg", "deg", "the same, mean of the last tenth"},
            {"agreed_on_rotation", "",
             "1 if rotation_disagreement_end_deg is below 1/8 of the angle by which the lattice "
             "repeats, else 0; its mean is the share of trials whose vehicles agreed"},
            {"energy_agreed_wh", "Wh", "energy_mean_wh of a trial whose vehicles agreed"},
            {"energy_not_agreed_wh", "Wh", "energy_mean_wh of a trial whose vehicles did not"}};
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
    const std::optional<double> end_deg = mean_between(end_from * world.time_s(), world.time_s());
    results.add("rotation_disagreement_end_deg", end_deg);
    std::optional<double> agreed, energy_agreed, energy_not_agreed;
    if (end_deg) {
      const bool yes = *end_deg < agreement_below_deg(order_);
      agreed = yes ? 1.0 : 0.0;
      (yes ? energy_agreed : energy_not_agreed) = energy_mean_wh(world);
    }
    results.add("agreed_on_rotation", agreed);
    results.add("energy_agreed_wh", energy_agreed);
    results.add("energy_not_agreed_wh", energy_not_agreed);
    results.add_series("rotation_disagreement_deg", time_s_, spread_deg_);
  }

 private:
  static std::optional<double> energy_mean_wh(const scenarios::World& world) {
    const auto total = over_survivors(world, [&](std::size_t i) {
      return world.propulsion_wh(i) + world.hotel_wh(i) + world.comms_wh(i);
    });
    return total ? std::optional(total->mean) : std::nullopt;
  }

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

const Register<Measure, Disagreement> registered{
    "disagreement", "how much vehicles disagree on the rotation of the plan"};

}  // namespace
}  // namespace shoal::analysis
