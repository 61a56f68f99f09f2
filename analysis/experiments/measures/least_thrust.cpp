#include <algorithm>
#include <cmath>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

constexpr double least_share = 0.2;

/// Where in the formation the vehicles are that thrust least (Rypkema 2015, sec. 5.3.1): their
/// distance from the centroid, a mean over the mission, as a share of that of the outermost
/// vehicle. Of the vehicles that are left, the fifth that was least under a command to move.
class LeastThrust final : public Measure {
 public:
  static void declare(Options<LeastThrust>&) {}

  std::vector<Quantity> values() const override {
    return {{"least_thrust_radius", "",
             "distance from the centroid / that of the outermost vehicle, mean of the fifth of the "
             "vehicles that thrust least"}};
  }

  void begin(const scenarios::World& world) override {
    every_s_ = series_interval_s(world);
    distance_m_.assign(world.size(), 0.0);
  }

  void observe(const scenarios::World& world) override {
    survivors(world, places_, vehicles_);
    if (places_.empty()) return;
    const Eigen::Vector2d centroid = mean_of(places_);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      distance_m_[static_cast<std::size_t>(vehicles_[k])] += (places_[k] - centroid).norm();
    }
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::vector<std::size_t> left;
    double outermost_m = 0.0, thrusting_s = 0.0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i)) continue;
      left.push_back(i);
      outermost_m = std::max(outermost_m, distance_m_[i]);
      thrusting_s += world.logbook(i).thrusting_s;
    }
    if (outermost_m <= 0.0 || thrusting_s <= 0.0) {
      results.add("least_thrust_radius", std::nullopt);
      return;
    }
    std::ranges::stable_sort(left, {}, [&](std::size_t i) { return world.logbook(i).thrusting_s; });
    left.resize(static_cast<std::size_t>(
        std::max(1.0, std::round(least_share * static_cast<double>(left.size())))));
    const double sum =
        std::accumulate(left.begin(), left.end(), 0.0,
                        [&](double so_far, std::size_t i) { return so_far + distance_m_[i]; });
    results.add("least_thrust_radius", sum / static_cast<double>(left.size()) / outermost_m);
  }

 private:
  std::vector<double> distance_m_;  // of each vehicle from the centroid, summed over the looks
  std::vector<Eigen::Vector2d> places_;
  std::vector<int> vehicles_;
};

const Register<Measure, LeastThrust> registered{
    "least_thrust", "where in the formation the vehicles are that thrust least"};

}  // namespace
}  // namespace shoal::analysis
