#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "shoal/core/grid_index.hpp"
#include "shoal/formations/planner.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::scenarios {

class World;

/// Looks at the world from time to time and changes nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Seconds between two looks; a multiple of the tick.
  virtual double every_s() const = 0;
  virtual void observe(const World& world) = 0;
  /// The formation quality so far, if that is what it measures: a stop rule may go by it.
  virtual std::optional<QualitySoFar> quality() const { return std::nullopt; }
};

/// What one vehicle has done since mission start.
struct Logbook {
  double thrusting_s = 0.0;         ///< time under a command to move (not latched as drifting)
  double distance_m = 0.0;          ///< over ground
  double thrust_distance_m = 0.0;   ///< of that, while moving through the water
  double outside_envelope_s = 0.0;  ///< moved in a way from which no command is admissible
  std::int64_t pings_sent = 0;
};

/// A swarm in its sea.
///
/// Time goes in ticks. Between the instants at which vehicles influence one another (pings, losses)
/// or an observer looks, every vehicle listens, plans, is guided and moves on its own; blocks of
/// vehicles run through such a stretch in parallel, and the numbers do not depend on how many
/// threads there are. Nothing is allocated in the steady state.
class World {
 public:
  /// Opens everything the scenario names. Throws InputError.
  explicit World(const Scenario& scenario, int threads = 1);
  ~World();

  /// Shows an observer what the planner of a vehicle does; see Planner::observe().
  void observe_planner(std::size_t i, formations::PlanObserver& observer) {
    planners_[i].observe(observer);
  }

  /// Runs the mission to its end. Each observer looks at time zero, then at its own interval, and
  /// last at the end of the mission if that is one of its instants. The end is after
  /// trial.duration_s, or earlier where arrival or the stop rule ends the trial. Throws InputError
  /// if that rule goes by the formation quality and no observer measures it.
  void run(std::span<Observer* const> observers);

  /// What ended the trial: "duration", "arrival", or the kind of its stop rule. After run().
  const std::string& stopped_by() const { return stopped_by_; }

  double time_s() const { return static_cast<double>(tick_) * scenario_.trial.tick_s; }
  std::size_t size() const { return swarm_->size(); }
  const Scenario& scenario() const { return scenario_; }
  const formations::Plan& plan() const { return *plan_; }
  const Swarm& swarm() const { return *swarm_; }
  const std::vector<std::shared_ptr<const formations::Obstacle>>& obstacles() const {
    return obstacles_;
  }
  const formations::Behaviour& behaviour() const { return *behaviour_; }
  const formations::Guidance& guidance() const { return *guidance_; }
  const StopRule& stop() const { return *stop_; }
  const Fault& fault() const { return *fault_; }
  bool lost(std::size_t i) const { return lost_s_[i] >= 0.0; }
  std::size_t lost_count() const { return lost_count_; }
  const Logbook& logbook(std::size_t i) const { return logbooks_[i]; }
  const formations::Planner& planner(std::size_t i) const { return planners_[i]; }
  const formations::Command& command(std::size_t i) const { return commands_[i]; }
  /// Velocity of the water (m/s, east and north) by which a vehicle last moved; zero before that.
  Eigen::Vector2d current_m_s(std::size_t i) const { return {u_m_s_[i], v_m_s_[i]}; }

  /// When a vehicle's energy pack was empty, or negative. It then stands still in the water, unless
  /// energy.battery is "ignored".
  double empty_s(std::size_t i) const { return empty_s_[i]; }
  bool stopped(std::size_t i) const {
    return empty_s_[i] >= 0.0 && scenario_.energy.battery == Energy::Battery::limits;
  }

  /// When a vehicle was first at the waypoint, or negative.
  double arrived_s(std::size_t i) const { return arrived_s_[i]; }

  double propulsion_wh(std::size_t i) const;
  double hotel_wh(std::size_t i) const;
  double comms_wh(std::size_t i) const;

 private:
  std::int64_t next_event(std::span<const std::int64_t> looks) const;
  void end_now(const std::string& why);
  void lose_vehicles();
  void send_pings();
  void run_block(std::size_t first, std::size_t last, std::int64_t until);
  void listen_and_plan(std::size_t first, std::size_t last, std::int64_t tick);
  /// Whether the vehicle then has to plan.
  bool listen(std::size_t i, std::int64_t tick);
  void set_alarms(std::size_t i, std::int64_t tick, bool planned);
  void guide(std::size_t i);
  /// Whether it has gone for good: lost, or its energy pack is empty.
  bool silent(std::size_t i) const { return lost(i) || stopped(i); }
  void note_empty(std::size_t first, std::size_t last, double time_s);
  void note_arrivals(std::size_t first, std::size_t last, double time_s);
  bool arrival_ends_trial() const;
  bool all_arrived() const;
  std::int64_t emission_tick(std::size_t i, std::int64_t emission) const;

  /// Keeps what a ping says of its sender until it has arrived.
  const formations::OwnState* reported(std::size_t sender);

  Scenario scenario_;
  int threads_;
  std::size_t block_size_ = 0;
  RandomStreams random_;
  std::shared_ptr<const formations::Plan> plan_;
  std::unique_ptr<Current> current_;
  std::vector<std::shared_ptr<const formations::Obstacle>> obstacles_;
  std::shared_ptr<const formations::Behaviour> behaviour_;
  std::shared_ptr<const formations::Guidance> guidance_;
  Channel channel_;
  std::unique_ptr<Swarm> swarm_;
  std::unique_ptr<StopRule> stop_;
  std::unique_ptr<Fault> fault_;
  std::string stopped_by_ = "duration";

  std::vector<formations::Planner> planners_;
  std::vector<formations::Command> commands_;
  std::vector<Hydrophone> hydrophones_;
  std::vector<std::int64_t> forget_tick_;  // when what was heard for the last plan is forgotten
  std::vector<std::int64_t> wake_tick_;    // when the vehicle next has to listen or to plan
  std::vector<double> u_m_s_, v_m_s_;
  std::vector<double> x_before_m_, y_before_m_;  // a tick ago
  std::vector<Logbook> logbooks_;
  std::vector<double> lost_s_;  // when a vehicle was lost, or negative
  std::vector<double> arrived_s_;
  std::vector<double> empty_s_;
  std::vector<double> last_propulsion_j_;      // at that time
  std::vector<formations::OwnState> reports_;  // the last `reports_kept_` of each vehicle
  std::size_t reports_kept_ = 0;
  std::size_t lost_count_ = 0;
  std::vector<std::int64_t> next_emission_;  // tick
  GridIndex grid_;

  std::int64_t tick_ = 0, end_tick_, guidance_ticks_, planner_ticks_, loss_ticks_, forget_ticks_;
};

}  // namespace shoal::scenarios
