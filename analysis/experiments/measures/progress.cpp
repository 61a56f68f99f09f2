#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// How far the swarm came, and for how much energy (Rypkema 2015, sec. 5.4).
///
/// The path is the length of the centroid's track, sampled every 5 s as in the author's log. When a
/// vehicle is lost, the centroid of the others goes on from where it is: the jump is no path.
class Progress final : public Measure {
 public:
  static void declare(Options<Progress>&) {}

  std::vector<Quantity> values() const override {
    return {{"centroid_path_m", "m", "length of the track of the swarm's centroid"},
            {"centroid_displacement_m", "m", "how far the centroid came"},
            {"efficiency_m_per_wh", "m/Wh", "path of the centroid / mean energy"}};
  }

  std::vector<Quantity> series() const override {
    return {{"centroid_path_m", "m", "length of the track of the swarm's centroid"},
            {"efficiency_m_per_wh", "m/Wh", "path of the centroid / mean energy, so far"}};
  }

  void begin(const scenarios::World& world) override {
    every_s_ = log_interval_s(world);
    grid_.begin(series_interval_s(world));
  }

  void observe(const scenarios::World& world) override {
    std::vector<int> slots = std::move(slots_);
    std::vector<Eigen::Vector2d> positions = std::move(positions_);
    const std::size_t before = slots.size();
    survivors(world, positions, slots);
    if (!positions.empty()) {
      const Eigen::Vector2d centroid = mean_of(positions);
      if (!started_) {
        started_ = true;
      } else if (slots.size() == before) {
        path_m_ += (centroid - centroid_).norm();
        displacement_ += centroid - centroid_;
      }
      centroid_ = centroid;
    }
    slots_ = std::move(slots);
    positions_ = std::move(positions);
    if (started_ && grid_.due(world.time_s())) {
      path_at_m_.push_back(path_m_);
      if (const std::optional<double> energy_wh = energy_mean_wh(world)) {
        spending_s_.push_back(world.time_s());
        efficiency_.push_back(path_m_ / *energy_wh);
      }
    }
  }

  void finish(const scenarios::World& w, Results& results) const override {
    const std::optional<double> energy_wh = energy_mean_wh(w);
    results.add("centroid_path_m", path_m_);
    results.add("centroid_displacement_m", displacement_.norm());
    results.add("efficiency_m_per_wh",
                energy_wh ? std::optional(path_m_ / *energy_wh) : std::nullopt);
    results.add_series("centroid_path_m", grid_.time_s(), path_at_m_);
    results.add_series("efficiency_m_per_wh", spending_s_, efficiency_);
  }

 private:
  /// Nothing as long as no energy was spent.
  static std::optional<double> energy_mean_wh(const scenarios::World& w) {
    const auto energy = over_survivors(
        w, [&](std::size_t i) { return w.propulsion_wh(i) + w.hotel_wh(i) + w.comms_wh(i); });
    return energy && energy->mean > 0.0 ? std::optional(energy->mean) : std::nullopt;
  }

  SeriesGrid grid_;
  std::vector<double> path_at_m_, spending_s_, efficiency_;
  bool started_ = false;
  double path_m_ = 0.0;
  Eigen::Vector2d centroid_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d displacement_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> slots_;
};

const Register<Measure, Progress> registered{"progress",
                                             "how far the swarm came, and for how much energy"};

}  // namespace
}  // namespace shoal::analysis
