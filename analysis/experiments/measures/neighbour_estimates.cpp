#include <cmath>
#include <numbers>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/core/angles.hpp"

namespace shoal::analysis {
namespace {

/// How well vehicles know where their neighbours are: the filter of pings removes noise, and lags
/// while vehicles move (Rypkema 2015, sec. 3.3.1, fig. 3.5).
///
/// Of neighbours with an id, between hearing them and the next look, with the truth as it was when
/// they were heard. At rest are two vehicles that have made no way through the water for as long as
/// the filter remembers; a single measurement is as noisy as the range and bearing of a ping.
class NeighbourEstimates final : public Measure {
 public:
  double rest_m_s = 0.05;
  double moving_m_s = 0.3;

  static void declare(Options<NeighbourEstimates>& o) {
    using N = NeighbourEstimates;
    o.number("rest_m_s", &N::rest_m_s, "m/s", at_least(0),
             "a vehicle at this speed through the water, or below, makes no way");
    o.number("moving_m_s", &N::moving_m_s, "m/s", above(0),
             "a neighbour at this speed relative to the own, or above, moves");
  }

  std::vector<Quantity> values() const override {
    return {{"neighbour_error_m", "m", "error of the places of neighbours when heard, rms"},
            {"neighbour_noise_ratio", "",
             "the same of vehicles at rest / that of single measurements, rms"},
            {"neighbour_lag_m", "m",
             "how far places are behind, of neighbours that move at "
             "measure.neighbour_estimates.moving_m_s or more, mean"}};
  }

  void begin(const scenarios::World& world) override {
    if (!world.scenario().ping.identified || world.scenario().ping.carries_state) return;
    every_s_ = log_interval_s(world);
    moved_s_.assign(world.size(), 0.0);
  }

  void observe(const scenarios::World& world) override {
    const double now_s = world.time_s();
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.swarm().speed_m_s[i] > rest_m_s) moved_s_[i] = now_s;
    }
    const std::vector<Eigen::Vector2d> before = std::move(places_);
    places_.clear();
    for (std::size_t i = 0; i < world.size(); ++i) {
      places_.emplace_back(world.swarm().x_m[i], world.swarm().y_m[i]);
    }
    if (before.empty()) return;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const double planned_s = world.planner(i).last_plan_s();
      if (world.lost(i) || now_s - planned_s > every_s_) continue;
      for (const formations::Neighbour& neighbour : world.planner(i).last_neighbours()) {
        if (neighbour.slot == formations::anonymous) continue;
        const auto j = static_cast<std::size_t>(neighbour.slot);
        const double since_s = now_s - (planned_s - neighbour.age_s);
        if (world.lost(j) || since_s > every_s_) continue;
        const Eigen::Vector2d own_m_s = (places_[i] - before[i]) / every_s_;
        const Eigen::Vector2d other_m_s = (places_[j] - before[j]) / every_s_;
        const Eigen::Vector2d truth =
            (places_[j] - since_s * other_m_s) - (places_[i] - (now_s - planned_s) * own_m_s);
        compare(world, i, j, neighbour.position - truth, truth.norm(), other_m_s - own_m_s);
      }
    }
  }

  void finish(const scenarios::World&, Results& results) const override {
    const auto root = [](double sum, double of) {
      return of > 0.0 ? std::optional(std::sqrt(sum / of)) : std::nullopt;
    };
    results.add("neighbour_error_m", root(squares_, count_));
    results.add("neighbour_noise_ratio", root(rest_squares_, single_squares_));
    results.add("neighbour_lag_m", moving_ > 0.0 ? std::optional(lag_m_ / moving_) : std::nullopt);
  }

 private:
  void compare(const scenarios::World& world, std::size_t i, std::size_t j,
               const Eigen::Vector2d& error, double range_m, const Eigen::Vector2d& velocity) {
    squares_ += error.squaredNorm();
    count_ += 1.0;
    const double rest_since_s = world.time_s() - std::max(moved_s_[i], moved_s_[j]);
    if (rest_since_s >= world.scenario().ping_filter.timeout_s) {
      const scenarios::PingOptions& ping = world.scenario().ping;
      const double across_m = range_m * radians(ping.bearing_sd_deg);
      rest_squares_ += error.squaredNorm();
      single_squares_ += ping.range_sd_m * ping.range_sd_m + across_m * across_m;
    }
    if (velocity.norm() < moving_m_s) return;
    lag_m_ -= error.dot(velocity.normalized());
    moving_ += 1.0;
  }

  std::vector<double> moved_s_;  // when each vehicle last made way through the water
  std::vector<Eigen::Vector2d> places_;
  double squares_ = 0.0, count_ = 0.0, rest_squares_ = 0.0, single_squares_ = 0.0;
  double lag_m_ = 0.0, moving_ = 0.0;
};

const Register<Measure, NeighbourEstimates> registered{
    "neighbour_estimates", "how well vehicles know where their neighbours are"};

}  // namespace
}  // namespace shoal::analysis
