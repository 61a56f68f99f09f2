#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include "shoal/solvers/trace.hpp"
#include "shoal/solvers/unknowns.hpp"
#include "shoal/solvers/vector_function.hpp"

namespace shoal::solvers {

struct LeastSquares;

/// An objective of `dimension` unknowns with exact first and second derivatives.
///
/// `gradient` (dimension) and `hessian` (dimension x dimension, column-major) may be null: then
/// they are not wanted. Throwing is allowed and reaches the caller of the solver unchanged.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual double evaluate(const double* x, double* gradient, double* hessian) const = 0;

  /// Copies itself into `storage` if `size` suffices, else on the heap; the second value tells
  /// which.
  virtual std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const = 0;
};

/// What copy_into() does for any objective that can be copied.
template <class Concrete>
std::pair<Objective*, bool> copied_into(const Concrete& objective, void* storage,
                                        std::size_t size) {
  if (sizeof(Concrete) <= size && alignof(Concrete) <= alignof(std::max_align_t)) {
    return {new (storage) Concrete(objective), false};
  }
  return {new Concrete(objective), true};
}

/// A smooth problem: minimise the objective from the start, inside the bounds (if any), where all
/// constraints (if any) are at least zero, and all equalities (if any) are zero.
///
/// A copyable value. Small objectives and few unknowns are held in place, so that posing a problem
/// in a control loop does not allocate.
class Problem {
 public:
  using Vector = Unknowns;

  /// `objective`: any type derived from Objective (autodiff.hpp makes one of a templated cost).
  template <class Concrete>
  requires std::is_base_of_v<Objective, std::remove_cvref_t<Concrete>> Problem(
      const Vector& start_point, const Concrete& objective)
      : start(start_point) {
    adopt(objective);
  }
  Problem(const Problem& other);
  Problem& operator=(const Problem& other);
  ~Problem();

  int dimension() const { return static_cast<int>(start.size()); }
  bool constrained() const { return constraints || equalities; }
  double evaluate(const double* x, double* gradient = nullptr, double* hessian = nullptr) const {
    return objective_->evaluate(x, gradient, hessian);
  }

  Vector start;                 ///< metres, in the frame of the caller
  std::optional<Vector> lower;  ///< both or none
  std::optional<Vector> upper;
  std::shared_ptr<const VectorFunction> constraints;  ///< g(x) >= 0; nullptr: none
  std::shared_ptr<const VectorFunction> equalities;   ///< h(x) = 0; nullptr: none
  std::shared_ptr<const LeastSquares> least_squares;  ///< of the same cost; nullptr: has none
  std::optional<double> best_known;                   ///< the lowest cost known, for tests
  Trace* trace = nullptr;  ///< borrowed: where a solve notes its progress

 private:
  void adopt(const Objective& objective);
  void release();

  static constexpr std::size_t in_place_bytes = 256;
  alignas(std::max_align_t) unsigned char in_place_[in_place_bytes];
  Objective* objective_ = nullptr;
  bool on_heap_ = false;
};

}  // namespace shoal::solvers
