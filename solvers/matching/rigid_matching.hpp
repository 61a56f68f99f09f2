#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shoal/core/transform.hpp"
#include "shoal/solvers/matching/lattice_search.hpp"
#include "shoal/solvers/matching/pose_search.hpp"

namespace shoal::solvers {

struct RigidMatchingOptions {
  double tolerance_m = 0.01;  ///< between the mean distance and its lower bound; above 0
  /// How many distances are looked at before the search ends with a wider gap; the first few
  /// assignments are made in any case.
  std::int64_t budget = 400'000;
};

enum class RigidMatchStatus : std::uint8_t {
  exact,   ///< to the tolerance
  budget,  ///< the lower bound tells how far the truth may be
};

struct RigidMatch {
  Transform2 T_slots_points;   ///< lays the points onto the slots
  double mean_m = 0.0;         ///< distance between points and their slots
  double lower_bound_m = 0.0;  ///< no motion and no assignment has a lower mean
  std::int64_t work = 0;       ///< distances looked at
  RigidMatchStatus status = RigidMatchStatus::exact;
};

/// The least mean distance between points, moved rigidly (turned and shifted, never reflected), and
/// slots, one of its own for each point; with a proof.
///
/// Where the slots are part of a lattice, its infinite continuation is searched first
/// (LatticeSearch): there one cell stands for all, and a formation that fits the plan is as good in
/// both. What is left open is searched over the plan itself (PoseSearch).
///
/// The same points, slots, options and prior give the same bits. Keeps its work space between
/// calls: one object per thread.
class RigidMatching {
 public:
  /// Slots in metres, finite, at least one. Throws std::invalid_argument otherwise, and for a
  /// tolerance that is not above 0.
  explicit RigidMatching(std::span<const Eigen::Vector2d> slots,
                         const RigidMatchingOptions& options = {});

  /// Points in metres, finite, at least one and not more than slots: throws std::invalid_argument
  /// otherwise. `prior`, a motion that is likely to be nearly right, makes the search shorter; it
  /// changes the answer within the tolerance, or the gap, only.
  RigidMatch match(std::span<const Eigen::Vector2d> points,
                   const std::optional<Transform2>& prior = std::nullopt);

  /// Of the last match.
  std::span<const int> slot_of_point() const { return plan_.best().slot_of_point; }

 private:
  void try_turns(std::int64_t most_work);
  std::int64_t work() const { return plan_.work() + (lattice_ ? lattice_->work() : 0); }

  RigidMatchingOptions options_;
  Eigen::Vector2d slots_centroid_;
  PoseSearch plan_;  // over the slots about their centroid
  int symmetry_;     // of these
  std::optional<LatticeSearch> lattice_;
  std::vector<Eigen::Vector2d> points_;  // about their centroid
};

}  // namespace shoal::solvers
