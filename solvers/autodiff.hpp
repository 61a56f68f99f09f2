#pragma once

#include <Eigen/Core>
#include <memory>

#include "shoal/solvers/problem.hpp"
#include "shoal/solvers/taylor.hpp"

namespace shoal::solvers {

/// Makes an objective with exact gradient and Hessian of a cost that is templated on its scalar:
///
///     struct Bowl { template <class T> T operator()(const T* x) const { return x[0]*x[0]; } };
///     Problem problem(start, differentiated<2>(Bowl{}));
///
/// Numbers of fixed size carry the derivatives (taylor.hpp): nothing is allocated.
template <int N, class Cost>
class Differentiated final : public Objective {
 public:
  explicit Differentiated(const Cost& cost) : cost_(cost) {}

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    if (!gradient && !hessian) return cost_(x);
    Taylor<N> unknowns[N];
    for (int i = 0; i < N; ++i) unknowns[i] = Taylor<N>::unknown(x[i], i);
    const Taylor<N> y = cost_(static_cast<const Taylor<N>*>(unknowns));
    if (gradient) Eigen::Map<typename Taylor<N>::Gradient>{gradient} = y.gradient;
    if (hessian) Eigen::Map<typename Taylor<N>::Hessian>{hessian} = y.hessian;
    return y.value;
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    return copied_into(*this, storage, size);
  }

 private:
  Cost cost_;
};

template <int N, class Cost>
Differentiated<N, Cost> differentiated(const Cost& cost) {
  return Differentiated<N, Cost>(cost);
}

/// Makes residuals or constraints of a function that is templated on its scalar and gives one
/// block at a time:
///
///     struct NoCloserThan {
///       static constexpr int block_size = 1;
///       int blocks() const { return 1; }
///       template <class T>
///       void operator()(int, const T* x, T* g) const { g[0] = x[0]*x[0] + x[1]*x[1] - 25.0; }
///     };
///     problem.constraints = differentiated_blocks<2>(NoCloserThan{});
template <int N, class Blocks>
class DifferentiatedBlocks final : public VectorFunction {
 public:
  explicit DifferentiatedBlocks(const Blocks& function) : function_(function) {}

  int blocks() const override { return function_.blocks(); }
  int block_size() const override { return M; }

  void evaluate(int block, const double* x, double* values, double* jacobian,
                double* hessians) const override {
    if (!jacobian && !hessians) return function_(block, x, values);
    Taylor<N> unknowns[N], y[M];
    for (int i = 0; i < N; ++i) unknowns[i] = Taylor<N>::unknown(x[i], i);
    function_(block, static_cast<const Taylor<N>*>(unknowns), y);
    for (std::ptrdiff_t k = 0; k < M; ++k) {
      values[k] = y[k].value;
      if (jacobian) Eigen::Map<typename Taylor<N>::Gradient>{jacobian + k* N} = y[k].gradient;
      if (hessians) Eigen::Map<typename Taylor<N>::Hessian>{hessians + k* N* N} = y[k].hessian;
    }
  }

 private:
  static constexpr int M = Blocks::block_size;
  static_assert(M >= 1 && M <= max_block_size);

  Blocks function_;
};

template <int N, class Blocks>
std::shared_ptr<const VectorFunction> differentiated_blocks(const Blocks& function) {
  return std::make_shared<const DifferentiatedBlocks<N, Blocks>>(function);
}

}  // namespace shoal::solvers
