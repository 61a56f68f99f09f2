#include <memory>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/formation_quality.hpp"
#include "shoal/analysis/experiments/measures/quality_history.hpp"
#include "shoal/core/text.hpp"

namespace shoal::analysis {
namespace {

constexpr double good_m = 20.0;
constexpr double last_from = 0.9;

/// The formation quality against time (Rypkema 2015, sec. 4.3), with the plan padded by layers of
/// lattice positions. Vehicles that are lost no longer count.
class Quality final : public Measure {
 public:
  static void declare(Options<Quality>&) {}

  void begin(const scenarios::World& world) override {
    const scenarios::QualityOptions& options = world.scenario().quality;
    every_s_ = options.every_s;
    if (every_s_ <= 0.0) return;
    for (std::size_t i = 0; i < world.size(); ++i) start_.push_back(position(world, i));
    const formations::Plan padded =
        world.scenario().plan.make()->padded(static_cast<int>(options.layers));
    require_searchable(padded, world.size(), options);
    measure_ = std::make_shared<FormationQuality>(padded, options);
  }

  std::vector<Quantity> values() const override {
    return {
        {"quality_final_m", "m", "formation quality at the end of the mission"},
        {"quality_settled_m", "m", "mean quality in the last 60 % of the mission"},
        {"time_to_quality_20m_s", "s", "when the quality was first below 20 m",
         "quality_watched_s"},
        {"quality_worst_m", "m", "greatest quality in the last 60 % of the mission"},
        {"quality_last_m", "m", "mean quality in the last 10 % of the mission"},
        {"quality_trend_m_per_h", "m/h", "slope of the quality in the last 60 % of the mission"},
        {"quality_oscillation_m", "m",
         "rms of the formed swarm's quality about its mean over 10 minutes"},
        {"quality_swing_m", "m",
         "how much the quality rises and falls again in the 10 minutes after the swarm formed"},
        {"quality_watched_s", "s", "how long the quality was watched"},
        {.name = "energy_to_quality_20m_wh",
         .unit = "Wh",
         .meaning = "mean energy spent until the quality was below 20 m, or all if it never was",
         .event = "time_to_quality_20m_s"},
        {.name = "path_straightness",
         .unit = "",
         .meaning = "distance from start / length of track, mean of vehicles, when the quality was "
                    "first below 20 m, or at the end if it never was",
         .event = "time_to_quality_20m_s"},
        {"quality_gap_max_m", "m",
         "greatest distance of the quality above its proven lower bound, in the whole mission"},
        {"quality_gap_settled_m", "m",
         "greatest distance of the quality above its proven lower bound, in the last 60 % of the "
         "mission"}};
  }

  std::vector<Quantity> series() const override {
    return {{"quality", "m", "formation quality (Rypkema 2015, sec. 4.3)"},
            {"quality_gap_m", "m", "how far the quality may be above the least of all motions"}};
  }

  /// One look is to take seconds at most.
  static void require_searchable(const formations::Plan& padded, std::size_t vehicles,
                                 const scenarios::QualityOptions& options) {
    constexpr int most_slots = 10'000;
    if (padded.size() > most_slots) {
      throw InputError("quality.layers = " + std::to_string(options.layers) + " pads the plan to " +
                       std::to_string(padded.size()) + " slots, and at most " +
                       std::to_string(most_slots) +
                       " are searched; take fewer layers, or set "
                       "quality.every_s = 0");
    }
    if (options.alignment == scenarios::QualityOptions::Alignment::rigid) return;
    constexpr double most_distances = 1e9;
    const double distances =
        360.0 / options.delta_theta_deg * padded.size() * static_cast<double>(vehicles);
    if (distances <= most_distances) return;
    throw InputError("quality.delta_theta_deg = " + shortest(options.delta_theta_deg) + " and " +
                     std::to_string(padded.size()) + " slots are " + shortest(distances) +
                     " distances for each look at the quality, and may be " +
                     shortest(most_distances) + "; take larger steps or fewer layers");
  }

  void observe(const scenarios::World& world) override {
    survivors(world, positions_, slots_);
    if (positions_.empty()) return;
    time_s_.push_back(world.time_s());
    const FormationQuality::Value value = measure_->of(positions_);
    quality_m_.push_back(value.quality_m);
    if (value.lower_bound_m) {
      gap_time_s_.push_back(world.time_s());
      gap_m_.push_back(value.quality_m - *value.lower_bound_m);
    }
    if (reached_s_) return;
    if (quality_m_.back() < good_m) reached_s_ = world.time_s();
    spent_wh_ = over_survivors(world, [&](std::size_t i) {
                  return world.propulsion_wh(i) + world.hotel_wh(i) + world.comms_wh(i);
                })->mean;
    straightness_ = straightness(world);
  }

  std::optional<scenarios::QualitySoFar> quality() const override {
    if (!measure_) return std::nullopt;
    return scenarios::QualitySoFar{time_s_, quality_m_};
  }

  void finish(const scenarios::World& world, Results& results) const override {
    const QualityHistory history(time_s_, quality_m_, world.time_s());
    results.add("quality_final_m",
                quality_m_.empty() ? std::nullopt : std::optional(quality_m_.back()));
    results.add("quality_settled_m", history.mean_m(settled_from));
    results.add("time_to_quality_20m_s", reached_s_);
    results.add("quality_worst_m", history.worst_m(settled_from));
    results.add("quality_last_m", history.mean_m(last_from));
    results.add("quality_trend_m_per_h", history.trend_m_per_h(settled_from));
    results.add("quality_oscillation_m", history.oscillation_m());
    results.add("quality_swing_m", history.swing_m());
    results.add("quality_watched_s",
                time_s_.empty() ? std::nullopt : std::optional(time_s_.back()));
    results.add("energy_to_quality_20m_wh", spent_wh_);
    results.add("path_straightness", straightness_);
    const QualityHistory gaps(gap_time_s_, gap_m_, world.time_s());
    results.add("quality_gap_max_m", gaps.worst_m(0.0));
    results.add("quality_gap_settled_m", gaps.worst_m(settled_from));
    results.add_series("quality", time_s_, quality_m_);
    results.add_series("quality_gap_m", gap_time_s_, gap_m_);
  }

 private:
  static Eigen::Vector2d position(const scenarios::World& world, std::size_t i) {
    return {world.swarm().x_m[i], world.swarm().y_m[i]};
  }

  /// Nothing as long as a vehicle has not moved.
  std::optional<double> straightness(const scenarios::World& world) const {
    const auto share = over_survivors(world, [&](std::size_t i) {
      const double length_m = world.logbook(i).distance_m;
      return length_m > 0.0 ? (position(world, i) - start_[i]).norm() / length_m : -1.0;
    });
    return share && share->least >= 0.0 ? std::optional(share->mean) : std::nullopt;
  }

  std::shared_ptr<FormationQuality> measure_;
  std::vector<Eigen::Vector2d> start_;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> slots_;
  std::vector<double> time_s_, quality_m_;
  std::vector<double> gap_time_s_, gap_m_;  // where the measure proves a lower bound
  std::optional<double> reached_s_;
  std::optional<double> spent_wh_, straightness_;  ///< until then, or so far
};

const Register<Measure, Quality> registered{
    "quality", "the formation quality: how far vehicles are from the plan laid onto them"};

}  // namespace
}  // namespace shoal::analysis
