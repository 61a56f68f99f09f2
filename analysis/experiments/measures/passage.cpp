#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

/// How a swarm makes its way: to a waypoint, past obstacles, in formation.
///
/// Only of trials whose behaviour leads to a waypoint, or that have obstacles: at every tick then.
/// The cell error compares the distances of all pairs, in order of their size, with those of the
/// plan: it does not ask which vehicle is where. Under way is until the last vehicle has arrived.
class Passage final : public Measure {
 public:
  static void declare(Options<Passage>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"arrived_vehicles", "", "vehicles that have been at the waypoint"},
        {"stranded_share", "", "share of the vehicles that never were"},
        {"passage_watched_s", "s", "how long vehicles had to come to the waypoint"},
        {"arrival_first_s", "s", "when the first vehicle was at the waypoint", "passage_watched_s"},
        {"arrival_last_s", "s", "when the last one was, if all were", "passage_watched_s"},
        {.name = "arrival_spread_s",
         .unit = "s",
         .meaning = "between the first arrival and the last, or the end if not all arrived",
         .event = "arrival_last_s"},
        {"clearance_min_m", "m", "closest that a vehicle came to an obstacle's edge"},
        {"cell_error_rms_m", "m", "error of the distances between vehicles under way, rms"},
        {"cell_error_worst_m", "m", "the same, rms over pairs, at the worst instant"},
        {"cell_error_final_m", "m", "the same at the end"},
        {"control_effort_m_s", "m/s", "commanded acceleration over time, mean of vehicles"},
        {"outside_envelope_share", "",
         "share of the time in motions from which no command is admissible, mean of vehicles"}};
  }

  std::vector<Quantity> series() const override {
    return {{"cell_error_m", "m", "error of the distances between vehicles, rms over pairs"},
            {"separation_m", "m", "distance of the closest pair"},
            {"clearance_m", "m", "distance of the closest vehicle and obstacle"}};
  }

  void begin(const scenarios::World& world) override {
    waypoint_ = world.scenario().waypoint.has_value();
    if (!waypoint_ && world.obstacles().empty()) return;
    every_s_ = world.scenario().trial.tick_s;
    grid_.begin(log_interval_s(world));
    const formations::Plan& plan = world.plan();
    // Beyond that, pairs cost more than the simulation.
    few_ = plan.size() <= 64;
    if (waypoint_ && few_) pair_distances(plan.slots(), wanted_);
  }

  void observe(const scenarios::World& world) override {
    survivors(world, positions_, slots_);
    if (few_) pair_distances(positions_, distances_);
    const double clearance = least_clearance(world);
    clearance_ = std::min(clearance_, clearance);

    std::optional<double> error;
    if (!wanted_.empty() && distances_.size() == wanted_.size()) {
      double squares = 0.0;
      for (std::size_t k = 0; k < wanted_.size(); ++k) {
        squares += (distances_[k] - wanted_[k]) * (distances_[k] - wanted_[k]);
      }
      squares /= static_cast<double>(wanted_.size());
      error = last_error_ = std::sqrt(squares);
      if (!all_arrived(world)) {
        squares_ += squares;
        worst_error_ = std::max(worst_error_, *error);
        ++looks_;
      }
    }
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i) || !world.planner(i).last_target().force_m_s2) continue;
      const formations::Command& command = world.command(i);
      effort_ +=
          std::hypot(command.acceleration_m_s2, command.speed_m_s * command.turn_rate_rad_s) *
          every_s_;
      forced_ = true;
    }
    if (!grid_.due(world.time_s())) return;
    const double t = world.time_s();
    if (error) cell_error_.add(t, *error);
    if (!distances_.empty()) separation_.add(t, distances_.front());
    if (std::isfinite(clearance)) clearances_.add(t, clearance);
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::vector<double> arrivals;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.arrived_s(i) >= 0.0) arrivals.push_back(world.arrived_s(i));
    }
    std::ranges::sort(arrivals);
    const auto if_way = [&](double value) {
      return waypoint_ ? std::optional(value) : std::nullopt;
    };
    results.add("arrived_vehicles", if_way(static_cast<double>(arrivals.size())));
    results.add("stranded_share",
                if_way(1.0 - static_cast<double>(arrivals.size()) /
                                 static_cast<double>(std::max<std::size_t>(1, world.size()))));
    results.add("passage_watched_s", if_way(world.time_s()));
    results.add("arrival_first_s",
                arrivals.empty() ? std::nullopt : std::optional(arrivals.front()));
    results.add("arrival_last_s", all_arrived(world) && !arrivals.empty()
                                      ? std::optional(arrivals.back())
                                      : std::nullopt);
    const double until_s =
        all_arrived(world) && !arrivals.empty() ? arrivals.back() : world.time_s();
    results.add("arrival_spread_s",
                arrivals.empty() ? std::nullopt : std::optional(until_s - arrivals.front()));
    results.add("clearance_min_m",
                std::isfinite(clearance_) ? std::optional(clearance_) : std::nullopt);
    const auto if_looked = [&](double value) {
      return looks_ > 0 ? std::optional(value) : std::nullopt;
    };
    results.add("cell_error_rms_m", if_looked(std::sqrt(squares_ / std::max(looks_, 1))));
    results.add("cell_error_worst_m", if_looked(worst_error_));
    results.add("cell_error_final_m", last_error_);
    results.add(
        "control_effort_m_s",
        forced_ ? std::optional(effort_ / static_cast<double>(world.size())) : std::nullopt);
    results.add("outside_envelope_share",
                forced_ && world.time_s() > 0.0
                    ? std::optional(outside_envelope_s(world) / world.time_s())
                    : std::nullopt);
    results.add_series("cell_error_m", cell_error_.time_s, cell_error_.numbers);
    results.add_series("separation_m", separation_.time_s, separation_.numbers);
    results.add_series("clearance_m", clearances_.time_s, clearances_.numbers);
  }

 private:
  struct History {
    std::vector<double> time_s, numbers;
    void add(double t, double number) {
      time_s.push_back(t);
      numbers.push_back(number);
    }
  };

  static void pair_distances(std::span<const Eigen::Vector2d> points,
                             std::vector<double>& distances) {
    distances.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) distances.push_back((points[i] - points[j]).norm());
    }
    std::ranges::sort(distances);
  }

  double least_clearance(const scenarios::World& world) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& obstacle : world.obstacles()) {
      for (const Eigen::Vector2d& place : positions_) {
        least = std::min(least, obstacle->nearest(place).distance);
      }
    }
    return least;
  }

  static double outside_envelope_s(const scenarios::World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.size(); ++i) sum += world.logbook(i).outside_envelope_s;
    return sum / static_cast<double>(world.size());
  }

  bool all_arrived(const scenarios::World& world) const {
    if (!waypoint_) return false;
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (!world.lost(i) && world.arrived_s(i) < 0.0) return false;
    }
    return true;
  }

  bool waypoint_ = false, few_ = false, forced_ = false;
  std::vector<Eigen::Vector2d> positions_;
  std::vector<int> slots_;
  std::vector<double> wanted_, distances_;
  double clearance_ = std::numeric_limits<double>::infinity();
  double squares_ = 0.0, worst_error_ = 0.0, effort_ = 0.0;
  int looks_ = 0;
  std::optional<double> last_error_;
  SeriesGrid grid_;
  History cell_error_, separation_, clearances_;
};

const Register<Measure, Passage> registered{"passage",
                                            "the way to a waypoint, past obstacles, in formation"};

}  // namespace
}  // namespace shoal::analysis
