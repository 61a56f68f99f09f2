#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

namespace shoal::solvers {

/// Several functions of the unknowns at once: the residuals or the constraints of a problem.
///
/// They come in blocks of equal size: the two coordinates of a point that misses its place belong
/// together and share one loss; constraints and equalities are blocks of one.
class VectorFunction {
 public:
  static constexpr int max_block_size = 3;

  virtual ~VectorFunction() = default;
  virtual int blocks() const = 0;
  virtual int block_size() const = 0;

  /// The unknowns that a block depends on, rising and valid as long as the function; empty: all.
  virtual std::span<const int> unknowns_of(int block) const {
    (void)block;
    return {};
  }

  /// Whether it is linear in the unknowns: its Hessians are zero, and backends need not ask.
  virtual bool linear() const { return false; }

  /// The values (block_size) of one block at x. With n of unknowns_of(), or all if that is empty:
  /// the Jacobian (block_size x n, row-major) and the Hessians (block_size times n x n) by those
  /// unknowns, where they are not null.
  virtual void evaluate(int block, const double* x, double* values, double* jacobian,
                        double* hessians) const = 0;

  int size() const { return blocks() * block_size(); }
};

/// One block with its derivatives by all `dimension` unknowns, laid out as evaluate() does where a
/// block depends on all.
void evaluate_by_all(const VectorFunction& function, int block, int dimension, const double* x,
                     double* values, double* jacobian, double* hessians);

/// A x - b, a block a row; each depends on the unknowns whose coefficients are not zero. As
/// constraints: A x >= b. Throws std::invalid_argument if the sizes differ, a row is zero, or a
/// number is not finite.
std::shared_ptr<const VectorFunction> linear_function(const Eigen::MatrixXd& A,
                                                      const Eigen::VectorXd& b);

}  // namespace shoal::solvers
