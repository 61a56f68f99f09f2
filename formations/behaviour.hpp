#pragma once

#include <memory>
#include <span>

#include "shoal/core/memory.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/formations/neighbourhood.hpp"
#include "shoal/formations/plan.hpp"
#include "shoal/formations/solving.hpp"
#include "shoal/formations/target.hpp"

namespace shoal::formations {

/// Turns what a vehicle heard into a problem, has it solved, and returns the target.
///
/// Stateless and thread-safe: one behaviour serves a whole swarm. What it remembers of a vehicle is
/// a Memory of that vehicle's planner. Reads no files, draws no random numbers, and does not know
/// whether it is simulated.
class Behaviour {
 public:
  static constexpr const char* family = "behaviour";
  static constexpr const char* family_meaning = "turns what was heard into a target";

  virtual ~Behaviour() = default;

  /// Every problem is solved through `solving`. The memory may make an answer quicker, or be part
  /// of what the behaviour goes by; without one it answers as the first time.
  virtual Target step(const Neighbourhood& seen, const Plan& plan,
                      const Solving& solving) const = 0;
  virtual std::unique_ptr<Memory> new_memory() const { return nullptr; }

  /// Whether vehicles that plan at one instant are handed over at once, which pays where a call
  /// costs more than an answer.
  virtual bool plans_together() const { return false; }

  /// What step() answers to each of them. `solving` and `targets` are as long as `seen`.
  virtual void step_together(std::span<const Neighbourhood> seen, const Plan& plan,
                             std::span<const Solving> solving, std::span<Target> targets) const {
    for (std::size_t i = 0; i < seen.size(); ++i) targets[i] = step(seen[i], plan, solving[i]);
  }

  /// Without memory, and unobserved.
  Target step(const Neighbourhood& seen, const Plan& plan) const {
    return step(seen, plan, Solving());
  }

  /// True if anonymous neighbours are of no use to it.
  virtual bool needs_ids() const = 0;

  /// True if it leads vehicles to the waypoint.
  virtual bool needs_waypoint() const { return false; }

  /// True if its targets are forces; any other's are places.
  virtual bool gives_forces() const { return false; }

  /// True if its targets change as the vehicle moves: they must be renewed by the clock, not only
  /// when pings were heard.
  virtual bool needs_clock() const { return false; }
};

}  // namespace shoal::formations
