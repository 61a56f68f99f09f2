#include "shoal/formations/planner.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::formations {

namespace {

bool finite(const OwnState& state) {
  return state.position.allFinite() && state.velocity.allFinite() &&
         std::isfinite(state.heading_rad) && std::isfinite(state.speed_m_s) &&
         std::isfinite(state.turn_rate_rad_s);
}

}  // namespace

Planner::Planner(std::shared_ptr<const Plan> plan, std::shared_ptr<const Behaviour> behaviour,
                 std::string_view own_name, const PingFilterOptions& filter, Obstacles obstacles)
    : plan_(std::move(plan)),
      behaviour_(std::move(behaviour)),
      own_slot_(plan_->index_of(own_name)),
      filter_(filter),
      obstacles_(obstacles) {}

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
  if (!std::isfinite(time_s) || !finite(own)) {
    throw InputError("planning needs a finite time and a finite own state; the last target holds");
  }
  const double latest_s = std::max(last_ping_s_, last_plan_s_);
  if (time_s < latest_s) {
    throw InputError("a plan at t = " + shortest(time_s) +
                     " s comes after a ping or a plan of t = " + shortest(latest_s) +
                     " s; time must not go back");
  }
  target_ = behaviour_->step({filter_.neighbours(time_s, own.position), own_slot_, own, obstacles_},
                             *plan_);
  last_plan_s_ = time_s;
  target_position_ = own.position + target_.position;
  return target_;
}

}  // namespace shoal::formations
