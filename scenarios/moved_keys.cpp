#include "shoal/scenarios/moved_keys.hpp"

#include <string>

namespace shoal::scenarios {
namespace {

struct Moved {
  const char* from;
  const char* to;
};

constexpr Moved moved_keys[] = {
    {"guidance.speed_m_s", "guidance.drift.speed_m_s"},
    {"guidance.capture_radius_m", "guidance.drift.capture_radius_m"},
    {"guidance.slip_radius_m", "guidance.drift.slip_radius_m"},
    {"guidance.slip", "guidance.drift.slip"},
    {"guidance.drifting_radius_m", "guidance.drift.drifting_radius_m"},
    {"guidance.end_speed_scale", "guidance.drift.end_speed_scale"},
    {"guidance.targets_filter_size", "guidance.drift.targets_filter_size"},
    {"guidance.period_s", "guidance.drift.period_s or guidance.conditioned_force.period_s"},
    {"envelope", "guidance.conditioned_force.envelope"},
    {"arrival.radius_m", "waypoint.radius_m"},
    {"arrival.ends_trial", "waypoint.ends_trial"},
    {"arrival", "waypoint"},
    {"behaviour.virtual_potential.waypoint_x_m", "waypoint.x_m"},
    {"behaviour.virtual_potential.waypoint_y_m", "waypoint.y_m"},
    {"behaviour.virtual_potential_step.waypoint_x_m", "waypoint.x_m"},
    {"behaviour.virtual_potential_step.waypoint_y_m", "waypoint.y_m"},
    {"behaviour.attraction_repulsion.cohesion.waypoint.x_m", "waypoint.x_m"},
    {"behaviour.attraction_repulsion.cohesion.waypoint.y_m", "waypoint.y_m"},
    {"behaviour.assignment_registration.delta_theta_deg",
     "behaviour.assignment_registration.matching.sampled.delta_theta_deg"},
    {"ping.sound_speed_m_s", "ping.propagation.straight.sound_speed_m_s"},
    {"ping.loss_probability", "ping.loss.independent.probability"},
};

[[noreturn]] void refuse(const std::string& from, const std::string& to, const Origin& origin) {
  throw InputError(origin, from + " is now " + to + "; write that");
}

}  // namespace

void require_no_moved_keys(const Setting& root) {
  for (const auto& [from, to] : moved_keys) {
    if (const Setting* written = root.find_path(from)) refuse(from, to, written->origin);
  }
}

void require_not_moved(std::string_view key, const Origin& origin) {
  for (const auto& [from, to] : moved_keys) {
    if (key == from || key.starts_with(std::string(from) + ".")) refuse(from, to, origin);
  }
}

}  // namespace shoal::scenarios
