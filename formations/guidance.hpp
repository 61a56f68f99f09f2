#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal::formations {

/// What the vehicle's own controllers are asked for. Without thrust the heading is free.
struct Command {
  bool thrust = false;
  double heading_rad = 0.0;  ///< counter-clockwise from east
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;  ///< on the way to that speed, for controllers that ask
  double turn_rate_rad_s = 0.0;    ///< on the way to that heading, counter-clockwise
  /// The vehicle moves in a way from which its envelope allows no command (see AdmissibleSet).
  bool outside_envelope = false;
};

/// Steers to a relative target, then lets the vehicle drift: Rypkema 2015, sec. 3.2, Alg. 1-2,
/// Table 3.1.
///
/// Algorithm 1 as printed has no memory of having arrived and would thrust again between the slip
/// and the drifting radius. Section 3.2 describes the latch that is here: once arrived, the vehicle
/// drifts until it leaves the drifting radius, also when the target moves inside it.
struct DriftGuidance {
  enum class Slip { not_closing, receding };

  double speed_m_s = 1.0;
  double capture_radius_m = 3.0;
  double slip_radius_m = 10.0;
  double drifting_radius_m = 20.0;
  Slip slip = Slip::not_closing;
  double end_speed_scale = 0.5;
  std::int64_t targets_filter_size = 1;
  double period_s = 0.25;

  static void declare(Options<DriftGuidance>& o);
  std::optional<std::string> complaint() const;

  /// What one vehicle remembers between commands.
  struct State {
    bool drifting = true;
    double previous_distance_m = std::numeric_limits<double>::infinity();
    std::vector<Eigen::Vector2d> recent_targets;
  };

  /// The command for a target given relative to the vehicle (metres, own frame).
  Command command(const Eigen::Vector2d& relative_target, State& state) const {
    // Most of the time, most vehicles drift near their targets.
    const bool near = relative_target.squaredNorm() <= drifting_radius_m * drifting_radius_m;
    if (state.drifting && near && targets_filter_size == 1) return {};
    return steer(relative_target, state);
  }

 private:
  Command steer(const Eigen::Vector2d& relative_target, State& state) const;
};

}  // namespace shoal::formations
