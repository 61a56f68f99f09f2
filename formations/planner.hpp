#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "shoal/formations/behaviour.hpp"
#include "shoal/formations/ping_filter.hpp"
#include "shoal/formations/plan.hpp"

namespace shoal::formations {

/// The formation planner of one vehicle: pings in, targets out.
///
/// This is what a vehicle, or somebody else's simulator, links. It needs no simulation of ours, no
/// files, threads or global state, and does not allocate once it has met its neighbours.
///
/// Own positions are metres east and north in any fixed frame (dead reckoning will do); only their
/// differences matter, unless there are obstacles or the behaviour has a way-point: those are
/// places of this frame. Plan, behaviour and obstacles may be shared by many planners and threads.
class Planner {
 public:
  /// Throws InputError if the plan has no slot of that name.
  /// The obstacles must outlive the planner.
  Planner(std::shared_ptr<const Plan> plan, std::shared_ptr<const Behaviour> behaviour,
          std::string_view own_name, const PingFilterOptions& filter = {},
          Obstacles obstacles = {});

  /// A ping was heard while the vehicle was at `own_position`. Pings must come in time order.
  /// Throws InputError if a number is not finite, the range is negative, the ping is older than the
  /// last one, or the sender's slot is the own one or unknown to the plan.
  void receive(const Ping& ping, const Eigen::Vector2d& own_position);

  /// Plans anew from what was heard so far and returns the target relative to the vehicle. Only
  /// behaviours that give forces use more of the own state than the position. Throws InputError,
  /// and changes nothing, if time or state is not finite or the time is before the last ping or
  /// plan.
  const Target& plan(double time_s, const OwnState& own);

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
  std::shared_ptr<const Plan> plan_;
  std::shared_ptr<const Behaviour> behaviour_;
  int own_slot_;
  PingFilter filter_;
  Obstacles obstacles_;
  double last_ping_s_ = -std::numeric_limits<double>::infinity();
  double last_plan_s_ = -std::numeric_limits<double>::infinity();
  Target target_ = Target::hold(Reason::no_neighbour);
  Eigen::Vector2d target_position_ = Eigen::Vector2d::Zero();
};

}  // namespace shoal::formations
