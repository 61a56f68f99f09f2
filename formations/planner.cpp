#include "shoal/formations/planner.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::formations {

Planner::Planner(std::shared_ptr<const Plan> plan, std::shared_ptr<const Behaviour> behaviour,
                 std::string_view own_name, const PlannerParts& parts)
    : plan_(std::move(plan)),
      behaviour_(std::move(behaviour)),
      own_slot_(plan_->index_of(own_name)),
      filter_(parts.ping_filter),
      guidance_(parts.guidance),
      obstacles_(parts.obstacles),
      waypoint_(parts.waypoint) {
  if (waypoint_ && !waypoint_->allFinite()) {
    throw InputError("the waypoint is not finite; give metres east and north");
  }
  if (behaviour_->needs_waypoint() && !waypoint_) {
    throw InputError("the behaviour leads vehicles to a waypoint, and there is none; give one");
  }
  behaviour_memory_ = behaviour_->new_memory();
  if (!guidance_) return;
  if (behaviour_->gives_forces() && !guidance_->takes_forces()) {
    throw InputError("the behaviour gives forces, and the guidance takes places");
  }
  if (!behaviour_->gives_forces() && guidance_->takes_forces()) {
    throw InputError("the behaviour gives places, and the guidance takes forces");
  }
  guidance_memory_ = guidance_->new_memory();
}

bool Planner::finite(const OwnState& state) {
  return state.position.allFinite() && state.velocity.allFinite() &&
         std::isfinite(state.heading_rad) && std::isfinite(state.speed_m_s) &&
         std::isfinite(state.turn_rate_rad_s);
}

void Planner::refuse_command() const {
  if (!guidance_) throw InputError("this planner has no guidance, and gives targets only");
  throw InputError("a command needs a finite own state; the last command holds");
}

void Planner::receive(const Ping& ping, const Eigen::Vector2d& own_position) {
  if (!std::isfinite(ping.time_s) || !std::isfinite(ping.range_m) || ping.range_m < 0.0 ||
      !std::isfinite(ping.bearing_rad) || !std::isfinite(ping.elevation_rad) ||
      !own_position.allFinite() || (ping.state && !finite(*ping.state))) {
    throw InputError("a ping needs finite numbers and a range of at least 0 m; drop this one");
  }
  if (ping.slot != anonymous && (ping.slot < 0 || ping.slot >= plan_->size())) {
    throw InputError("a ping says slot " + std::to_string(ping.slot) +
                     ", but the plan has slots 0 to " + std::to_string(plan_->size() - 1));
  }
  if (ping.slot == own_slot_) {
    throw InputError("a ping carries the own id " + plan_->name(own_slot_) +
                     "; drop echoes of the own pings");
  }
  if (ping.time_s < last_ping_s_) {
    throw InputError("a ping of t = " + shortest(ping.time_s) + " s comes after one of t = " +
                     shortest(last_ping_s_) + " s; give them in the order of their times");
  }
  last_ping_s_ = ping.time_s;
  filter_.receive(ping, own_position);
}

const Target& Planner::plan(double time_s, const OwnState& own) {
  require_plannable(time_s, own);
  const Neighbourhood seen = look(time_s, own);
  take(behaviour_->step(seen, *plan_, solving()), seen, time_s);
  return target_;
}

void Planner::plan_together(std::span<Planner* const> planners, double time_s,
                            std::span<const OwnState> own) {
  if (planners.empty()) return;
  thread_local std::vector<Neighbourhood> seen;
  thread_local std::vector<Solving> solving;
  seen.clear();
  solving.clear();
  for (std::size_t i = 0; i < planners.size(); ++i) {
    planners[i]->require_plannable(time_s, own[i]);
  }
  for (std::size_t i = 0; i < planners.size(); ++i) {
    seen.push_back(planners[i]->look(time_s, own[i]));
    solving.push_back(planners[i]->solving());
  }
  thread_local std::vector<Target> targets;
  targets.resize(planners.size());
  planners[0]->behaviour_->step_together(seen, *planners[0]->plan_, solving, targets);
  for (std::size_t i = 0; i < planners.size(); ++i) {
    planners[i]->take(targets[i], seen[i], time_s);
  }
}

void Planner::require_plannable(double time_s, const OwnState& own) const {
  if (!std::isfinite(time_s) || !finite(own)) {
    throw InputError("planning needs a finite time and a finite own state; the last target holds");
  }
  const double latest_s = std::max(last_ping_s_, last_plan_s_);
  if (time_s < latest_s) {
    throw InputError("a plan at t = " + shortest(time_s) +
                     " s comes after a ping or a plan of t = " + shortest(latest_s) +
                     " s; time must not go back");
  }
}

Neighbourhood Planner::look(double time_s, const OwnState& own) {
  return {.neighbours = filter_.neighbours(time_s, own.position),
          .own_slot = own_slot_,
          .own = own,
          .obstacles = obstacles_,
          .waypoint = waypoint_.value_or(Eigen::Vector2d::Zero())};
}

void Planner::take(const Target& target, const Neighbourhood& seen, double time_s) {
  target_ = target;
  for (PlanObserver* observer : observers_) observer->planned(seen, target_);
  last_plan_s_ = time_s;
  target_position_ = seen.own.position + target_.position;
}

}  // namespace shoal::formations
