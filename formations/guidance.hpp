#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "shoal/core/memory.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/formations/target.hpp"

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

/// Turns a target into a command: heading and speed, or to drift.
///
/// Stateless and thread-safe: one law serves a whole swarm. What it remembers of a vehicle between
/// two commands is a Memory of that vehicle's planner.
class Guidance {
 public:
  static constexpr const char* family = "guidance";
  static constexpr const char* family_meaning = "turns a target into heading and speed, or drift";

  virtual ~Guidance() = default;

  /// `to_target`: from the vehicle to its target now (m, own frame), zero while it holds; `memory`:
  /// what new_memory() made for the vehicle.
  virtual Command command(const Target& target, const Eigen::Vector2d& to_target,
                          const OwnState& own, Memory* memory) const = 0;
  virtual std::unique_ptr<Memory> new_memory() const { return nullptr; }

  /// Time between two commands, s.
  virtual double period_s() const = 0;

  /// Whether it takes forces; any other takes places.
  virtual bool takes_forces() const { return false; }

  /// Whether it goes by more of the own state than the position.
  virtual bool needs_motion() const { return false; }

  /// The highest speed that it asks for, m/s.
  virtual double highest_speed_m_s() const = 0;

  /// How far from its target a vehicle may drift, m, if it lets vehicles drift.
  virtual std::optional<double> drifting_radius_m() const { return std::nullopt; }
};

/// The first kind of guidance that takes forces, or places.
std::string guidance_for(bool forces);

}  // namespace shoal::formations
