#include "shoal/analysis/experiments/measure.hpp"

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
        {"thrust_distance_ratio_spread", "", "greatest - least share of distance"}};
  }

  std::vector<Quantity> series() const override {
    return {{"thrust_time_ratio_mean", "", "share of time so far under a command to move"},
            {"thrust_time_ratio_min", "", "of the vehicle with the least share"},
            {"thrust_time_ratio_max", "", "of the vehicle with the greatest share"},
            {"thrust_distance_ratio_mean", "", "mean distance thrusting / mean distance, so far"},
            {"thrust_distance_ratio_min", "", "of the vehicle with the least share"},
            {"thrust_distance_ratio_max", "", "of the vehicle with the greatest share"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = series_interval_s(world); }

  void observe(const scenarios::World& w) override {
    if (const auto share = of_time(w)) times_.add(w.time_s(), *share);
    if (const auto share = of_distance(w)) distances_.add(w.time_s(), *share);
  }

  void finish(const scenarios::World& w, Results& results) const override {
    const std::optional<Spread> time = of_time(w), distance = of_distance(w);
    const auto number = [](const std::optional<Spread>& spread, double Spread::*which) {
      return spread ? std::optional((*spread).*which) : std::nullopt;
    };
    const auto width = [](const std::optional<Spread>& spread) {
      return spread ? std::optional(spread->greatest - spread->least) : std::nullopt;
    };
    results.add("thrust_time_ratio_mean", number(time, &Spread::mean));
    results.add("thrust_time_ratio_min", number(time, &Spread::least));
    results.add("thrust_time_ratio_max", number(time, &Spread::greatest));
    results.add("thrust_distance_ratio_mean", mean_over_mean(w));
    results.add("thrust_time_ratio_spread", width(time));
    results.add("thrust_distance_ratio_min", number(distance, &Spread::least));
    results.add("thrust_distance_ratio_max", number(distance, &Spread::greatest));
    results.add("thrust_distance_ratio_spread", width(distance));
    times_.append_to(results, "thrust_time_ratio_");
    distances_.append_to(results, "thrust_distance_ratio_");
  }

 private:
  /// Mean, least and greatest share against time.
  struct History {
    std::vector<double> time_s, mean, least, greatest;

    void add(double time, const Spread& share) {
      time_s.push_back(time);
      mean.push_back(share.mean);
      least.push_back(share.least);
      greatest.push_back(share.greatest);
    }
    void append_to(Results& results, const std::string& name) const {
      results.add_series(name + "mean", time_s, mean);
      results.add_series(name + "min", time_s, least);
      results.add_series(name + "max", time_s, greatest);
    }
  };

  /// Nothing at mission start: no time has passed that could be shared.
  static std::optional<Spread> of_time(const scenarios::World& w) {
    if (w.time_s() <= 0.0) return std::nullopt;
    return over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrusting_s / w.time_s(); });
  }

  /// Nothing as long as a vehicle has not moved. The mean is that of the thesis.
  static std::optional<Spread> of_distance(const scenarios::World& w) {
    if (!all_moved(w)) return std::nullopt;
    auto share = over_survivors(
        w, [&](std::size_t i) { return w.logbook(i).thrust_distance_m / w.logbook(i).distance_m; });
    share->mean = *mean_over_mean(w);
    return share;
  }

  static std::optional<double> mean_over_mean(const scenarios::World& w) {
    const auto distance = over_survivors(w, [&](std::size_t i) { return w.logbook(i).distance_m; });
    if (!distance || distance->mean <= 0.0) return std::nullopt;
    const auto thrusting =
        over_survivors(w, [&](std::size_t i) { return w.logbook(i).thrust_distance_m; });
    return thrusting->mean / distance->mean;
  }

  static bool all_moved(const scenarios::World& w) {
    const auto distance = over_survivors(w, [&](std::size_t i) { return w.logbook(i).distance_m; });
    return distance && distance->least > 0.0;
  }

  History times_, distances_;
};

const Register<Measure, Thrust> registered{"thrust",
                                           "shares of time and of distance spent thrusting"};

}  // namespace
}  // namespace shoal::analysis
