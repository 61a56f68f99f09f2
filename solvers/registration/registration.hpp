#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "shoal/core/registry.hpp"
#include "shoal/core/transform.hpp"
#include "shoal/solvers/answer.hpp"
#include "shoal/solvers/loss.hpp"
#include "shoal/solvers/trace.hpp"

namespace shoal::solvers {

/// Two points that belong together, each in metres in its own frame.
struct PointPair {
  Eigen::Vector2d from, to;
  double weight = 1.0;  ///< at least 0; a pair of weight zero does not count
};

/// The rigid motion that lays the `from` points best onto their `to` points: minimises
/// sum weight * loss(|R from + t - to|^2) over rotations and translations, never reflections
/// (Rypkema 2015, eq. 3.8, with any loss).
struct RegistrationProblem {
  std::span<const PointPair> pairs;
  const Loss* loss = nullptr;  ///< nullptr: the square
  Trace* trace = nullptr;      ///< borrowed: where a solve by descent notes its progress

  bool is_square() const { return !loss || loss->is_square(); }
};

/// Its cost is the weighted sum of losses, m^2. `undetermined`: the points do not fix the rotation
/// (fewer than two distinct ones), which is then the identity.
struct RegistrationSolution : Answer {
  static constexpr double unset = std::numeric_limits<double>::quiet_NaN();

  /// Takes `from` points to `to` points; NaN until set.
  Transform2 T_to_from{unset, unset, Eigen::Vector2d(unset, unset)};
};

/// Finds the best rigid motion of known pairs.
///
/// Stateless: one solver may serve many threads. Never throws for numerical trouble (that is a
/// status); throws what the loss throws. The same problem gives the same bits.
class RegistrationSolver {
 public:
  static constexpr const char* family = "registration";
  static constexpr const char* family_meaning = "finds the best rigid motion of known pairs";

  virtual ~RegistrationSolver() = default;
  virtual RegistrationSolution solve(const RegistrationProblem& problem) const = 0;

  /// Why this solver cannot take problems of that loss, whatever the pairs, or nothing if it can. A
  /// problem that is refused is answered with `bad_input`.
  virtual std::optional<std::string> refuses(const RegistrationProblem& problem) const = 0;

  /// Why threads that use this solver wait for one another, or nothing if they do not.
  virtual std::optional<std::string> one_at_a_time() const { return std::nullopt; }
};

/// The closed form of the square, for what is no choice of a user.
std::unique_ptr<RegistrationSolver> closed_form();

/// Weighted sums of matched pairs, from which the best rigid motion follows in closed form.
///
/// Minimises sum w |R from + t - to|^2 over rotations and translations (never reflections):
/// Rypkema 2015, eq. 3.8. In the plane the singular value decomposition of his steps 3-5 reduces
/// to one angle, atan2(sum w from x to, sum w from . to) of the centred points.
class Procrustes {
 public:
  /// A pair of weight zero does not count; a negative weight makes the whole a bad input.
  void add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight);
  RegistrationSolution solve() const;

 private:
  // The first pair that counts is the origin of the sums, so that far-away swarms lose no digits.
  Eigen::Vector2d from_origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d from_sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d dot_cross_ = Eigen::Vector2d::Zero();  // sum of w f . t and w f x t
  Eigen::Array2d squared_ = Eigen::Array2d::Zero();      // sum of w f^2 and w t^2
  double weight_ = 0.0;
  bool any_ = false, bad_ = false;
};

inline void Procrustes::add(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double weight) {
  if (!(weight > 0.0)) {
    bad_ = bad_ || weight != 0.0;
    return;
  }
  if (!any_) {
    any_ = true;
    from_origin_ = from;
    to_origin_ = to;
  }
  const Eigen::Vector2d f = from - from_origin_;
  const Eigen::Vector2d t = to - to_origin_;
  weight_ += weight;
  from_sum_ += weight * f;
  to_sum_ += weight * t;
  dot_cross_ += weight * (f.x() * t + f.y() * Eigen::Vector2d(t.y(), -t.x()));
  const Eigen::Array2d x(f.x(), t.x()), y(f.y(), t.y());
  squared_ += weight * (x * x + y * y);
}

}  // namespace shoal::solvers
