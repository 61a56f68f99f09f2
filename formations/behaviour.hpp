#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shoal/core/registry.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/formations/plan.hpp"
#include "shoal/formations/posed_problems.hpp"

namespace shoal::formations {

/// Why a target is what it is.
enum class Reason : std::uint8_t {
  placed,         ///< the behaviour's problem was solved
  no_neighbour,   ///< nobody usable was heard: hold the own position
  one_neighbour,  ///< two are needed: hold
  degenerate,     ///< the neighbours fix no direction (coincident): hold
  solver_failed,  ///< the solver gave no usable point: hold
};
inline constexpr int reason_count = 5;
std::string_view name_of(Reason reason);

/// Where a vehicle should go, in its own frame. Holding means the own position: free drift.
struct Target {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< metres, own frame
  Reason reason = Reason::placed;
  double cost = 0.0;  ///< of the solved problem, in its own unit
  /// The plan as laid onto what was heard, if the behaviour lays one.
  std::optional<Transform2> T_own_plan = std::nullopt;
  /// m/s2, own frame, if the behaviour asks for a force per unit of mass instead of a place.
  std::optional<Eigen::Vector2d> force_m_s2 = std::nullopt;

  bool held() const { return reason != Reason::placed; }
  static Target at(const Eigen::Vector2d& position, double cost) {
    return {position, Reason::placed, cost};
  }
  /// At a slot (metres, frame of the plan) of a plan that was laid onto the neighbours.
  static Target at_slot(const Transform2& T_own_plan, const Eigen::Vector2d& slot, double cost) {
    return {T_own_plan * slot, Reason::placed, cost, T_own_plan};
  }
  static Target push(const Eigen::Vector2d& force_m_s2, double cost) {
    return {Eigen::Vector2d::Zero(), Reason::placed, cost, std::nullopt, force_m_s2};
  }
  static Target hold(Reason why) { return {Eigen::Vector2d::Zero(), why}; }
};

/// Turns what a vehicle heard into a problem, has it solved, and returns the target.
///
/// Stateless and thread-safe: one behaviour serves a whole swarm. Reads no files, draws no random
/// numbers, and does not know whether it is simulated.
class Behaviour {
 public:
  static constexpr const char* family = "behaviour";
  static constexpr const char* family_meaning = "turns what was heard into a target";

  virtual ~Behaviour() = default;
  virtual Target step(const Neighbourhood& seen, const Plan& plan) const = 0;

  /// Shows the problems that step() would solve, and the later ones of several as they follow from
  /// its own answers to the earlier. Nothing where step() would hold without solving any.
  virtual void pose(const Neighbourhood& seen, const Plan& plan, ProblemViewer& viewer) const = 0;

  /// True if anonymous neighbours are of no use to it.
  virtual bool needs_ids() const = 0;

  /// The one place that all vehicles are led to, also those that hear nobody (metres, frame of the
  /// own positions), if there is one.
  virtual std::optional<Eigen::Vector2d> waypoint() const { return std::nullopt; }

  /// True if its targets change as the vehicle moves: they must be renewed by the clock, not only
  /// when pings were heard.
  virtual bool needs_clock() const { return waypoint().has_value(); }
};

}  // namespace shoal::formations
