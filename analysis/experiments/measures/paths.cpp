#include <cmath>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/tracks.hpp"

namespace shoal::analysis {
namespace {

/// The ways of the vehicles over ground: how long, how straight, do they cross (Rypkema 2015,
/// sec. 5.1.1)? Tracks are in steps of 10 m and more; the approach is the part of a track up to
/// where the vehicle first is within arrived_m of its end. Vehicles that are lost have no end.
class Paths final : public Measure {
 public:
  double arrived_m = 30.0;  // the drifting radius and half of it

  static void declare(Options<Paths>& o) {
    o.number("arrived_m", &Paths::arrived_m, "m", at_least(0),
             "a vehicle that is this near to the end of its track, or nearer, has arrived");
  }

  std::vector<Quantity> values() const override {
    return {{"path_length_m", "m", "length of the track over ground, mean of vehicles"},
            {"path_detour", "",
             "length of all tracks / distance of all vehicles from where they started"},
            {"approach_straightness", "",
             "distance / length of the track up to measure.paths.arrived_m from its end, mean of "
             "vehicles"},
            {"arc_away_m", "m",
             "how much farther from its end a vehicle gets than at its start, mean of vehicles"},
            {"arc_share", "", "share of vehicles that get farther away by 10 m and more"},
            {"crossing_share", "",
             "share of pairs of vehicles whose tracks up to measure.paths.arrived_m from their "
             "ends cross"}};
  }

  void begin(const scenarios::World& world) override { every_s_ = log_interval_s(world); }

  void observe(const scenarios::World& world) override {
    log_.look(world, [](std::size_t) {});
  }

  void finish(const scenarios::World& world, Results& results) const override {
    const std::vector<Track> tracks = log_.ended(world);
    std::vector<std::span<const Eigen::Vector2d>> approaches;
    double length = 0.0, distance = 0.0, straightness = 0.0, away = 0.0, arcs = 0.0;
    int under_way = 0, count = 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (world.lost(i)) continue;
      const Track& track = tracks[i];
      ++count;
      length += length_m(track);
      distance += (track.back() - track.front()).norm();
      away += away_m(track);
      arcs += away_m(track) >= path_step_m ? 1.0 : 0.0;
      approaches.push_back(approach(track, arrived_m));
      if (approaches.back().size() < 2) continue;
      ++under_way;
      straightness +=
          (approaches.back().back() - track.front()).norm() / length_m(approaches.back());
    }
    const auto mean = [](double sum, int of) {
      return of > 0 ? std::optional(sum / of) : std::nullopt;
    };
    results.add("path_length_m", mean(length, count));
    results.add("path_detour", distance > 0.0 ? std::optional(length / distance) : std::nullopt);
    results.add("approach_straightness", mean(straightness, under_way));
    results.add("arc_away_m", mean(away, count));
    results.add("arc_share", mean(arcs, count));
    results.add("crossing_share",
                count > 1 ? std::optional(crossing_pairs(approaches) / (0.5 * count * (count - 1)))
                          : std::nullopt);
  }

 private:
  TrackLog log_{path_step_m};
};

const Register<Measure, Paths> registered{"paths",
                                          "how long and straight ways are, and do they cross"};

}  // namespace
}  // namespace shoal::analysis
