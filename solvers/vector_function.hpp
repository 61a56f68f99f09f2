#pragma once

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

  /// The values (block_size) of one block at x; the Jacobian (block_size x dimension, row-major)
  /// and the Hessians (block_size times dimension x dimension) where they are not null.
  virtual void evaluate(int block, const double* x, double* values, double* jacobian,
                        double* hessians) const = 0;

  int size() const { return blocks() * block_size(); }
};

}  // namespace shoal::solvers
