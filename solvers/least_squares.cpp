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
    constexpr int few = Unknowns::in_place;
    return dimension_ <= few ? evaluated<few>(x, gradient, hessian)
                             : evaluated<Eigen::Dynamic>(x, gradient, hessian);
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return copied_into(*this, storage, size);
  }

 private:
  /// Of at most n_max unknowns.
  template <int n_max>
  double evaluated(const double* x, double* gradient, double* hessian) const {
    constexpr int most = VectorFunction::max_block_size;
    constexpr int all = n_max == Eigen::Dynamic ? Eigen::Dynamic : most * n_max * n_max;
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, n_max, 1>;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, n_max, n_max>;
    using Jacobian =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most, n_max>;
    const VectorFunction& residuals = *structure_->residuals;
    const std::ptrdiff_t m = residuals.block_size();
    const std::ptrdiff_t n = dimension_;

    double cost = 0.0, r[most];
    Vector slope = Vector::Zero(n);
    Matrix curvature = Matrix::Zero(hessian ? n : 0, hessian ? n : 0);
    Jacobian J;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, all, 1> curvatures;
    for (int b = 0; b < residuals.blocks(); ++b) {
      const std::span<const int> own = residuals.unknowns_of(b);
      const std::ptrdiff_t k_own = own.empty() ? n : static_cast<std::ptrdiff_t>(own.size());
      J.resize(m, k_own);
      curvatures.resize(hessian ? m * k_own * k_own : 0);
      residuals.evaluate(b, x, r, gradient || hessian ? J.data() : nullptr,
                         hessian ? curvatures.data() : nullptr);
      double squared = 0.0;
      for (std::ptrdiff_t k = 0; k < m; ++k) squared += r[k] * r[k];
      const LossValue loss = structure_->loss_at(squared);
      const double weight = structure_->weight(b);
      cost += weight * loss.value;
      if (!gradient && !hessian) continue;

      const Vector pull =
          J.transpose() *
          Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>>(r, m);
      const auto add = [&](auto&& slope_here, auto&& curvature_here) {
        slope_here += 2.0 * weight * loss.slope * pull;
        if (!hessian) return;
        curvature_here += 2.0 * weight * loss.slope * (J.transpose() * J);
        curvature_here += 4.0 * weight * loss.curvature * (pull * pull.transpose());
        for (std::ptrdiff_t k = 0; k < m; ++k) {
          curvature_here +=
              2.0 * weight * loss.slope * r[k] *
              Eigen::Map<const Matrix>(curvatures.data() + k * k_own * k_own, k_own, k_own);
        }
      };
      if (own.empty()) {
        add(slope, curvature);
      } else if (hessian) {
        add(slope(own), curvature(own, own));
      } else {
        add(slope(own), curvature);
      }
    }
    if (gradient) Eigen::Map<Vector>(gradient, n) = slope;
    if (hessian) Eigen::Map<Matrix>(hessian, n, n) = curvature;
    return cost;
  }

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
