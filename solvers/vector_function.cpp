#include "shoal/solvers/vector_function.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "shoal/core/small_vector.hpp"

namespace shoal::solvers {
namespace {

class LinearFunction final : public VectorFunction {
 public:
  LinearFunction(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    if (A.rows() != b.size()) throw std::invalid_argument("A and b have different numbers of rows");
    if (!A.allFinite() || !b.allFinite()) {
      throw std::invalid_argument("a coefficient of a linear function is not finite");
    }
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      Row row{.offset = b[i]};
      for (Eigen::Index j = 0; j < A.cols(); ++j) {
        if (A(i, j) == 0.0) continue;
        row.unknowns.push_back(static_cast<int>(j));
        row.coefficients.push_back(A(i, j));
      }
      if (row.unknowns.empty()) {
        throw std::invalid_argument("a row of a linear function has no unknown");
      }
      rows_.push_back(std::move(row));
    }
  }

  int blocks() const override { return static_cast<int>(rows_.size()); }
  int block_size() const override { return 1; }
  std::span<const int> unknowns_of(int block) const override { return row(block).unknowns; }
  bool linear() const override { return true; }

  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    const auto& [unknowns, coefficients, offset] = row(block);
    values[0] = -offset;
    for (std::size_t k = 0; k < unknowns.size(); ++k) values[0] += coefficients[k] * x[unknowns[k]];
    if (jacobian) std::ranges::copy(coefficients, jacobian);
    if (hessians) std::fill_n(hessians, unknowns.size() * unknowns.size(), 0.0);
  }

 private:
  struct Row {
    std::vector<int> unknowns = {};
    std::vector<double> coefficients = {};
    double offset;
  };

  const Row& row(int block) const { return rows_[static_cast<std::size_t>(block)]; }

  std::vector<Row> rows_;
};

}  // namespace

void evaluate_by_all(const VectorFunction& function, int block, int dimension, const double* x,
                     double* values, double* jacobian, double* hessians) {
  const std::span<const int> own = function.unknowns_of(block);
  if (own.empty()) return function.evaluate(block, x, values, jacobian, hessians);
  const std::size_t m = static_cast<std::size_t>(function.block_size()), k = own.size();
  const auto n = static_cast<std::size_t>(dimension);
  SmallVector<double, 36> own_jacobian(jacobian ? m * k : 0),
      own_hessians(hessians ? m * k * k : 0);
  function.evaluate(block, x, values, jacobian ? own_jacobian.data() : nullptr,
                    hessians ? own_hessians.data() : nullptr);
  if (jacobian) std::fill_n(jacobian, m * n, 0.0);
  if (hessians) std::fill_n(hessians, m * n * n, 0.0);
  const auto place = [&](std::size_t i) { return static_cast<std::size_t>(own[i]); };
  for (std::size_t row = 0; row < m; ++row) {
    for (std::size_t i = 0; i < k; ++i) {
      if (jacobian) jacobian[row * n + place(i)] = own_jacobian[row * k + i];
      for (std::size_t j = 0; hessians && j < k; ++j) {
        hessians[(row * n + place(i)) * n + place(j)] = own_hessians[(row * k + i) * k + j];
      }
    }
  }
}

std::shared_ptr<const VectorFunction> linear_function(const Eigen::MatrixXd& A,
                                                      const Eigen::VectorXd& b) {
  return std::make_shared<const LinearFunction>(A, b);
}

}  // namespace shoal::solvers
