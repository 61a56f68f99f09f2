#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shoal/core/memory.hpp"
#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/guidance.hpp"
#include "shoal/formations/ping_filter.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::formations {

/// What a planner takes beside plan, behaviour and the own name.
struct PlannerParts {
  PingFilterOptions ping_filter = {};
  std::shared_ptr<const Guidance> guidance = nullptr;  ///< nullptr: targets only, no commands
  Obstacles obstacles = {};                            ///< must outlive the planner
  std::optional<Eigen::Vector2d> waypoint = std::nullopt;
};

/// Sees the problems of one vehicle's plans with their answers, and then what came of them.
class PlanObserver : public solvers::SolveObserver {
 public:
  /// `seen` is valid during the call only.
  virtual void planned(const Neighbourhood& seen, const Target& target) {
    (void)seen;
    (void)target;
  }
};

/// The formation planner of one vehicle: pings in, targets and commands out.
///
/// This is what a vehicle, or a simulator, links. It needs no simulation, no files, threads
/// or global state, and does not allocate once it has met its neighbours. A copy goes on as the
/// original does.
///
/// Own positions are metres east and north in any fixed frame (dead reckoning will do); only their
/// differences matter, unless there are obstacles or a waypoint: those are places of this frame.
/// Plan, behaviour, guidance and obstacles may be shared by many planners and threads.
class Planner {
 public:
  /// Throws InputError if the plan has no slot of that name, if the behaviour leads to a waypoint
  /// and there is none or it is not finite, and if it gives forces and the guidance takes places,
  /// or the other way round.
  Planner(std::shared_ptr<const Plan> plan, std::shared_ptr<const Behaviour> behaviour,
          std::string_view own_name, const PlannerParts& parts = {});

  /// A ping was heard while the vehicle was at `own_position`. Pings must come in time order.
  /// Throws InputError if a number is not finite, the range is negative, the ping is older than the
  /// last one, or the sender's slot is the own one or unknown to the plan.
  void receive(const Ping& ping, const Eigen::Vector2d& own_position);

  /// Plans anew from what was heard so far and returns the target relative to the vehicle. Only
  /// behaviours that give forces use more of the own state than the position. Throws InputError,
  /// and changes nothing, if time or state is not finite or the time is before the last ping or
  /// plan.
  const Target& plan(double time_s, const OwnState& own);

  /// plan() of several vehicles at one instant, each with its own state. They must share plan and
  /// behaviour. What throws for one changes none.
  static void plan_together(std::span<Planner* const> planners, double time_s,
                            std::span<const OwnState> own);

  /// The command on the way to the last target, or to drift before there is one. To be renewed
  /// every Guidance::period_s(). A guidance that does not ask for the motion goes by the position
  /// alone. Throws InputError without a guidance, and for a state that is not finite.
  Command command(const OwnState& own) {
    if (!guidance_ || !std::isfinite(own.position.x() + own.position.y())) refuse_command();
    if (guidance_->needs_motion() && !finite(own)) refuse_command();
    return guidance_->command(target_, target_from(own.position), own, guidance_memory_.get());
  }

  /// From now on the observer sees what this planner does, and so do those before it; it must
  /// outlive the planner. The numbers do not change.
  void observe(PlanObserver& observer) {
    observers_.push_back(&observer);
    solve_observers_.push_back(&observer);
    wants_ = Solving::wants_of(solve_observers_);
  }

  /// The last target, relative to where the vehicle is now. Before the first plan(): zero.
  Eigen::Vector2d target_from(const Eigen::Vector2d& own_position) const {
    return target_.held() ? Eigen::Vector2d::Zero().eval() : (target_position_ - own_position);
  }
  const Target& last_target() const { return target_; }

  /// The neighbours by which plan() last planned, relative to where the vehicle was then. Valid
  /// until the next plan().
  std::span<const Neighbour> last_neighbours() const { return filter_.last_neighbours(); }
  /// When that was; minus infinity before the first plan().
  double last_plan_s() const { return last_plan_s_; }

  int own_slot() const { return own_slot_; }

 private:
  static bool finite(const OwnState& state);
  [[noreturn]] void refuse_command() const;
  void require_plannable(double time_s, const OwnState& own) const;
  Neighbourhood look(double time_s, const OwnState& own);
  Solving solving() { return Solving(behaviour_memory_.get(), solve_observers_, wants_); }
  void take(const Target& target, const Neighbourhood& seen, double time_s);

  std::shared_ptr<const Plan> plan_;
  std::shared_ptr<const Behaviour> behaviour_;
  int own_slot_;
  PingFilter filter_;
  std::shared_ptr<const Guidance> guidance_;
  OwnedMemory behaviour_memory_, guidance_memory_;
  Obstacles obstacles_;
  std::optional<Eigen::Vector2d> waypoint_;
  std::vector<PlanObserver*> observers_;
  std::vector<solvers::SolveObserver*> solve_observers_;  // the same
  Solving::Wants wants_;
  double last_ping_s_ = -std::numeric_limits<double>::infinity();
  double last_plan_s_ = -std::numeric_limits<double>::infinity();
  Target target_ = Target::hold(Reason::no_neighbour);
  Eigen::Vector2d target_position_ = Eigen::Vector2d::Zero();
};

}  // namespace shoal::formations
