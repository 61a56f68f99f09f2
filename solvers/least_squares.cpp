#include "shoal/solvers/least_squares.hpp"

#include <stdexcept>

namespace shoal::solvers {
namespace {

/// The cost that belongs to the residuals, with its exact derivatives by the chain rule.
class SumOfLosses final : public Objective {
 public:
  SumOfLosses(std::shared_ptr<const LeastSquares> structure, int dimension)
      : structure_(std::move(structure)), dimension_(dimension) {}

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Problem::max_dimension,
                                 Problem::max_dimension>;
    constexpr int most = VectorFunction::max_block_size;
    constexpr int n_max = Problem::max_dimension;
    double r[most], jacobian[most * n_max], curvatures[most * n_max * n_max];
    const VectorFunction& residuals = *structure_->residuals;
    const std::ptrdiff_t m = residuals.block_size();
    const std::ptrdiff_t n = dimension_;

    double cost = 0.0;
    Problem::Vector slope = Problem::Vector::Zero(n);
    Matrix curvature = Matrix::Zero(n, n);
    for (int b = 0; b < residuals.blocks(); ++b) {
      residuals.evaluate(b, x, r, gradient || hessian ? jacobian : nullptr,
                         hessian ? curvatures : nullptr);
      double squared = 0.0;
      for (std::ptrdiff_t k = 0; k < m; ++k) squared += r[k] * r[k];
      const LossValue loss = structure_->loss_at(squared);
      const double weight = structure_->weight(b);
      cost += weight * loss.value;
      if (!gradient && !hessian) continue;

      const Eigen::Map<
          const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most, n_max>>
          J(jacobian, m, n);
      const Problem::Vector pull = J.transpose() * Eigen::Map<const Problem::Vector>(r, m);
      slope += 2.0 * weight * loss.slope * pull;
      if (!hessian) continue;
      curvature += 2.0 * weight * loss.slope * (J.transpose() * J);
      curvature += 4.0 * weight * loss.curvature * (pull * pull.transpose());
      for (std::ptrdiff_t k = 0; k < m; ++k) {
        curvature += 2.0 * weight * loss.slope * r[k] *
                     Eigen::Map<const Matrix>(curvatures + k * n * n, n, n);
      }
    }
    if (gradient) Eigen::Map<Problem::Vector>(gradient, n) = slope;
    if (hessian) Eigen::Map<Matrix>(hessian, n, n) = curvature;
    return cost;
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return copied_into(*this, storage, size);
  }

 private:
  std::shared_ptr<const LeastSquares> structure_;
  int dimension_;
};

}  // namespace

Problem least_squares_problem(const Problem::Vector& start, LeastSquares structure) {
  const auto blocks = static_cast<std::size_t>(structure.residuals->blocks());
  if (!structure.weights.empty() && structure.weights.size() != blocks) {
    throw std::invalid_argument("least squares: there must be one weight a block of residuals");
  }
  for (const double weight : structure.weights) {
    if (!(weight >= 0.0)) throw std::invalid_argument("least squares: a weight is negative or NaN");
  }
  const auto shared = std::make_shared<const LeastSquares>(std::move(structure));
  Problem problem(start, SumOfLosses(shared, static_cast<int>(start.size())));
  problem.least_squares = shared;
  return problem;
}

}  // namespace shoal::solvers
