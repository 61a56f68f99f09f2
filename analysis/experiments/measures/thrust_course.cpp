#include <algorithm>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// How the shares of time and of distance spent thrusting go (Rypkema 2015, sec. 5.4): up to their
/// peaks while the swarm forms, then down.
class ThrustCourse final : public Measure {
 public:
  static void declare(Options<ThrustCourse>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"thrust_time_ratio_peak", "", "greatest share of time thrusting so far, mean of vehicles"},
        {"thrust_distance_ratio_peak", "",
         "greatest mean distance thrusting / mean distance so far"},
        {"thrust_ratio_gap", "",
         "share of distance - share of time, mean from the peak of the latter on"}};
  }

  void finish(const scenarios::World&, Results& results) const override {
    const scenarios::Series& time = results.earlier_series("thrust_time_ratio_mean");
    const scenarios::Series& distance = results.earlier_series("thrust_distance_ratio_mean");
    results.add("thrust_time_ratio_peak", peak(time));
    results.add("thrust_distance_ratio_peak", peak(distance));
    results.add("thrust_ratio_gap", gap(time, distance));
  }

 private:
  static std::optional<double> peak(const scenarios::Series& series) {
    if (series.values.empty()) return std::nullopt;
    return std::ranges::max(series.values);
  }

  static std::optional<double> gap(const scenarios::Series& time,
                                   const scenarios::Series& distance) {
    const auto top = std::ranges::max_element(time.values);
    double sum = 0.0;
    int count = 0;
    // Both have the same instants, but for those at which the distance has none.
    std::size_t of = 0;
    for (auto k = static_cast<std::size_t>(top - time.values.begin()); k < time.values.size();
         ++k) {
      while (of < distance.time_s.size() && distance.time_s[of] < time.time_s[k]) ++of;
      if (of == distance.time_s.size() || distance.time_s[of] > time.time_s[k]) continue;
      sum += distance.values[of] - time.values[k];
      ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  }
};

const Register<Measure, ThrustCourse> registered{
    "thrust_course", "how the shares of time and of distance spent thrusting go"};

}  // namespace
}  // namespace shoal::analysis
