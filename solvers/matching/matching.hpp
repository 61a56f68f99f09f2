#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "shoal/core/memory.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/solvers/answer.hpp"

namespace shoal::solvers {

/// Steps of a search that samples rotations: at most 36,000 of them.
inline Range delta_theta_range_deg() {
  return in(0.01, 180.0);
}

/// Which slots of a plan do these points take, and how is the plan turned?
///
/// `points`: what is seen, the own position first. `slots`: all slots of the plan. Both in metres,
/// each in its own frame.
struct MatchingProblem {
  std::span<const Eigen::Vector2d> points;
  std::span<const Eigen::Vector2d> slots;
  double ownship_weight = 1.0;  ///< of points[0]; the others weigh 1
};

/// Its cost is the sum of matched distances before refinement, m.
struct MatchingSolution : Answer {
  std::span<const int> slot_of_point;  ///< valid until the next solve of this thread
  double rotation = 0.0;               ///< of the points onto the plan, rad
  /// Pairs of a subset of slots and a rotation among which the answer is the best: the assignments
  /// that an exhaustive search would solve; 0 if it is not a search of that kind.
  std::int64_t candidates = 0;
};

/// Stateless and thread-safe. What it remembers of a caller makes the next answer quicker, and
/// never another one.
class Matcher {
 public:
  static constexpr const char* family = "matching";
  static constexpr const char* family_meaning = "finds which slot of the plan each vehicle takes";

  virtual ~Matcher() = default;
  /// `memory`: what new_memory() made for the caller, or nullptr.
  virtual MatchingSolution solve(const MatchingProblem& problem, Memory* memory) const = 0;
  virtual std::unique_ptr<Memory> new_memory() const { return nullptr; }

  /// Why this solver cannot take the problem, or nothing if it can.
  virtual std::optional<std::string> refuses(const MatchingProblem&) const { return std::nullopt; }

  MatchingSolution solve(const MatchingProblem& problem) const { return solve(problem, nullptr); }
};

}  // namespace shoal::solvers
