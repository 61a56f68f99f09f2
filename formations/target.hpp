#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shoal/core/transform.hpp"

namespace shoal::formations {

/// Why a target is what it is.
enum class Reason : std::uint8_t {
  placed,         ///< the behaviour's problem was solved
  no_neighbour,   ///< no usable neighbour was heard: hold the own position
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

}  // namespace shoal::formations
