#pragma once

#include <memory>
#include <vector>

#include "shoal/solvers/loss.hpp"
#include "shoal/solvers/problem.hpp"

namespace shoal::solvers {

/// The structure of a cost that is the sum over blocks b of weight_b * loss(|residual_b|^2), for
/// solvers that make use of it. Without a half in front: with the loss r^2 and residuals in metres
/// it is a weighted sum of squares, in m^2.
struct LeastSquares {
  std::shared_ptr<const VectorFunction> residuals;
  std::shared_ptr<const Loss> loss;  ///< nullptr: the square
  std::vector<double> weights;       ///< one a block, at least 0; empty: all 1

  double weight(int block) const {
    return weights.empty() ? 1.0 : weights[static_cast<std::size_t>(block)];
  }
  LossValue loss_at(double squared) const {
    return loss ? loss->at(squared) : LossValue{squared, 1.0, 0.0};
  }
};

/// Poses the problem: every solver minimises the same cost, and those for least squares find its
/// residuals. Throws std::invalid_argument if weights are negative or do not fit.
Problem least_squares_problem(const Problem::Vector& start, LeastSquares structure);

}  // namespace shoal::solvers
