#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "shoal/solvers/matching/assignment.hpp"

namespace shoal::solvers {

/// Costs (m) closer than this are equal; among equals the first wins.
inline constexpr double cost_tie_m = 1e-6;

/// The rotations k * step, k = 1 ... floor(360 / step): a full turn that ends where it began if
/// the step divides 360 (Rypkema 2015, Alg. 8). Turn 0 is the rotation by one step.
class Turns {
 public:
  /// Throws InputError unless 0 < step_deg <= 360.
  explicit Turns(double step_deg);

  int count() const { return static_cast<int>(cosine_.size()); }
  double step_deg() const { return step_deg_; }
  double angle(int turn) const;  ///< rad
  double cosine(int turn) const { return cosine_[static_cast<std::size_t>(turn)]; }
  double sine(int turn) const { return sine_[static_cast<std::size_t>(turn)]; }

  /// Whether turning by this many degrees only permutes the turns.
  bool permuted_by(double angle_deg) const;

 private:
  double step_deg_;
  std::vector<double> cosine_, sine_;
};

/// Slots placed so that the origin is the centre of rotation, metres.
struct AlignedSlots {
  Eigen::ArrayXd x, y;
  Eigen::ArrayXd radius;  ///< of the slots, ascending

  AlignedSlots() = default;
  AlignedSlots(std::span<const Eigen::Vector2d> slots, const Eigen::Vector2d& centre);

  int size() const { return static_cast<int>(x.size()); }
};

/// The least sum of distances over all turns, and the turn that has it.
struct TurnedMatch {
  int turn = -1;  ///< -1: no turn was cheap enough
  double cost = std::numeric_limits<double>::infinity();
};

/// Turns a set of points about the origin and assigns them to slots so that the sum of the
/// distances is least: the inner loop of the assignment behaviour (Rypkema 2015, Alg. 8) and of the
/// formation quality metric (sec. 4.3).
///
/// The answer is that of the plain loop over all turns with an optimal assignment in each: the
/// first turn within cost_tie_m of the least cost. Most turns are ruled out by lower bounds: the
/// nearest slots of a few points, and the prices of the last assignment. Keeps its work space
/// between calls: one object per thread, nothing allocated once grown.
class RotationSearch {
 public:
  /// Points in metres, finite, placed so that the origin is the centre of rotation.
  void set_points(std::span<const Eigen::Vector2d> points);

  /// No turn costs less than this: rotation does not change how far a point is from the origin.
  double bound_below(const AlignedSlots& slots) const;

  /// Looks for turns that cost at most `limit`. Throws std::invalid_argument for more points than
  /// slots.
  ///
  /// Turns that cost up to `margin` more than the least are not ruled out either: visit_turns()
  /// shows them.
  TurnedMatch search(const Turns& turns, const AlignedSlots& slots,
                     double limit = std::numeric_limits<double>::infinity(), double margin = 0.0);

  /// Calls `visit(turn, cost)` for the turns that the last search did not rule out: all that cost
  /// less than its limit, and less than the least and the margin.
  template <class Visit>
  void visit_turns(Visit&& visit) const {
    for (std::size_t turn = 0; turn < cost_of_turn_.size(); ++turn) {
      const double cost = cost_of_turn_[turn];
      if (cost < std::numeric_limits<double>::infinity()) visit(static_cast<int>(turn), cost);
    }
  }

  /// The optimal assignment at one turn: slot_of_point() and cost() hold it.
  void match(const Turns& turns, const AlignedSlots& slots, int turn);
  std::span<const int> slot_of_point() const { return assignment_.column_of(); }
  double cost() const { return assignment_.cost(); }

 private:
  struct Point {
    double x, y, radius;
  };

  void turn_few(const Turns& turns);
  void glance(const AlignedSlots& slots, double limit);
  bool fill_costs(const AlignedSlots& slots, double cosine, double sine, double limit);

  std::vector<Point> points_;  // farthest first: they tell turns apart
  std::vector<Eigen::Vector2d> own_order_;
  std::vector<double> costs_, cost_of_turn_;
  // The farthest points at every turn, and what the nearest slots of theirs are away: floats do, as
  // they only rule out.
  Eigen::ArrayXXf turned_x_, turned_y_;  // turns x points
  Eigen::ArrayXf nearest_, glance_;      // by turn
  double turned_step_deg_ = 0.0;         // 0: not turned yet
  AssignmentSolver assignment_;
};

}  // namespace shoal::solvers
