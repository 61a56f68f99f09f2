#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "shoal/core/registry.hpp"
#include "shoal/core/transform.hpp"

namespace shoal::solvers {

/// The finest step of a search that samples rotations: 36,000 of them.
inline constexpr double least_delta_theta_deg = 0.01;

/// Which slots of a plan do these points take, and how is the plan turned?
///
/// `points`: what is seen, the own position first. `slots`: all slots of the plan. Both in metres,
/// each in its own frame.
struct MatchingProblem {
  std::span<const Eigen::Vector2d> points;
  std::span<const Eigen::Vector2d> slots;
  double ownship_weight = 1.0;    ///< of points[0]; the others weigh 1
  double delta_theta_deg = 10.0;  ///< step between the rotations tried, for searches that sample
  /// A small number of who asks, or -1. What he was told last may make the next answer quicker, and
  /// never another one.
  int asker = -1;
};

enum class MatchingStatus : std::uint8_t { matched, bad_input };

struct MatchingSolution {
  std::span<const int> slot_of_point;  ///< valid until the next solve of this thread
  double cost = 0.0;                   ///< sum of matched distances before refinement, m
  double rotation = 0.0;               ///< of the points onto the plan, rad
  MatchingStatus status = MatchingStatus::bad_input;

  bool usable() const { return status == MatchingStatus::matched; }
};

/// Stateless and thread-safe.
class Matcher {
 public:
  static constexpr const char* family = "matching";
  static constexpr const char* family_meaning = "finds which slot of the plan each vehicle takes";

  virtual ~Matcher() = default;
  virtual MatchingSolution solve(const MatchingProblem& problem) const = 0;
};

}  // namespace shoal::solvers
