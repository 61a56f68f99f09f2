#include <array>

#include "shoal/analysis/measure.hpp"

namespace shoal::analysis {
namespace {

/// Shares of time and of distance spent thrusting (Rypkema 2015, sec. 5.4). The time ratio counts
/// time under a command to move; the distance ratio is mean thrusting distance / mean distance,
/// with the glide after a thrust counted as thrusting, as in the author's log.
class Thrust final : public Measure {
 public:
  static void declare(Options<Thrust>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"thrust_time_ratio_mean", "", "share of time under a command to move, mean of vehicles"},
        {"thrust_time_ratio_min", "", "least share of time of a vehicle"},
        {"thrust_time_ratio_max", "", "greatest share of time of a vehicle"},
        {"thrust_distance_ratio_mean", "", "mean distance thrusting / mean distance"},
        {"thrust_time_ratio_spread", "", "greatest - least share of time"},
        {"thrust_distance_ratio_min", "", "least share of distance of a vehicle"},
        {"thrust_distance_ratio_max", "", "greatest share of distance of a vehicle"},
        {"thrust_distance_ratio_spread", "", "greatest - least share of distance"},
        {"path_straightness", "",
         "distance from start to end / length of track, mean of vehicles"}};
  }

  std::vector<Quantity> series() const override {
    return {{"thrust_time_ratio_mean", "", "share of time so far under a command to move"},
            {"thrust_time_ratio_min", "", "of the vehicle with the least share"},
            {"thrust_time_ratio_max", "", "of the vehicle with the greatest share"},
            {"thrust_distance_ratio_mean", "", "mean distance thrusting / mean distance, so far"},
            {"thrust_distance_ratio_min", "", "of the vehicle with the least share"},
            {"thrust_distance_ratio_max", "", "of the vehicle with the greatest share"}};
  }

  void begin(const scenarios::World& world) override {
    every_s_ = series_interval_s(world);
    for (std::size_t i = 0; i < world.size(); ++i) {
      start_.emplace_back(world.swarm().x_m[i], world.swarm().y_m[i]);
    }
  }

  void observe(const scenarios::World& w) override {
    const Ratios now = ratios(w);
    // At mission start nothing was travelled: there is no share of it yet.
    if (!now.time || !now.distance_mean || !now.distance) return;
    time_s_.push_back(w.time_s());
    const double numbers[] = {now.time->mean,     now.time->least,     now.time->greatest,
                              *now.distance_mean, now.distance->least, now.distance->greatest};
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].push_back(numbers[k]);
  }

  void finish(const scenarios::World& w, Results& results) const override {
    const Ratios end = ratios(w);
    const auto of = [](const std::optional<Spread>& spread, double Spread::*number) {
      return spread ? std::optional((*spread).*number) : std::nullopt;
    };
    const auto width = [](const std::optional<Spread>& spread) {
      return spread ? std::optional(spread->greatest - spread->least) : std::nullopt;
    };
    results.add("thrust_time_ratio_mean", of(end.time, &Spread::mean));
    results.add("thrust_time_ratio_min", of(end.time, &Spread::least));
    results.add("thrust_time_ratio_max", of(end.time, &Spread::greatest));
    results.add("thrust_distance_ratio_mean", end.distance_mean);
    results.add("thrust_time_ratio_spread", width(end.time));
    results.add("thrust_distance_ratio_min", of(end.distance, &Spread::least));
    results.add("thrust_distance_ratio_max", of(end.distance, &Spread::greatest));
    results.add("thrust_distance_ratio_spread", width(end.distance));
    results.add("path_straightness", straightness(w));
    const std::vector<Quantity> names = series();
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      results.add_series(names[k].name, time_s_, columns_[k]);
    }
  }

 private:
  struct Ratios {
    std::optional<Spread> time, distance;
    std::optional<double> distance_mean;
  };

  static bool moved(const scenarios::World& w) {
    const auto distance = over_survivors(w, [&](std::size_t i) { return w.logbook(i).distance_m; });
    return distance && distance->least > 0.0;
  }

  static Ratios ratios(const scenarios::World& w) {
    Ratios ratios;
    if (w.time_s() > 0.0) {
      ratios.time =
          over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrusting_s / w.time_s(); });
    }
    const auto distance = over_survivors(w, [&](std::size_t i) { return w.logbook(i).distance_m; });
    const auto thrusting =
        over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrust_distance_m; });
    if (distance && distance->mean > 0.0) ratios.distance_mean = thrusting->mean / distance->mean;
    if (moved(w)) {
      ratios.distance = over_survivors(w, [&](std::size_t i) {
        return w.logbook(i).thrust_distance_m / w.logbook(i).distance_m;
      });
    }
    return ratios;
  }

  std::optional<double> straightness(const scenarios::World& w) const {
    if (!moved(w)) return std::nullopt;
    return over_survivors(w,
                          [&](std::size_t i) {
                            const Eigen::Vector2d end(w.swarm().x_m[i], w.swarm().y_m[i]);
                            return (end - start_[i]).norm() / w.logbook(i).distance_m;
                          })
        ->mean;
  }

  std::vector<Eigen::Vector2d> start_;
  std::vector<double> time_s_;
  std::array<std::vector<double>, 6> columns_;
};

const Enrol<Measure, Thrust> enrolled{"thrust", "shares of time and of distance spent thrusting"};

}  // namespace
}  // namespace shoal::analysis
